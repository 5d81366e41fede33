"""Kernels: arrays in, arrays out; they know numbers only."""
