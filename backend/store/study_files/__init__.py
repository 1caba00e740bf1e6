"""Studies as one file: with curves, configs, final policies, models and a few episodes, for another installation."""
