"""Tests of towers: simulated scans, real clouds."""
