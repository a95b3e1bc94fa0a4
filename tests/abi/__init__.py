"""Checks of the hand-written Hydra declarations against the library that they describe."""
