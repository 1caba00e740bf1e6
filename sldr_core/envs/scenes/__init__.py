"""Scenes: MuJoCo models built from the ones that gymnasium-robotics ships."""
