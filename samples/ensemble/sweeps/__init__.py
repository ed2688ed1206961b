"""Sweeps of a scene of falling_particles: points, runs, results."""
