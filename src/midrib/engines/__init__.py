"""Layers of any size: partitions of them, on this machine or on a cluster, to parts of a result."""
