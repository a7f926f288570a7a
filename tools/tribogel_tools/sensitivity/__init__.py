"""Sensitivities of N and T: the parameters of a scene (`parameters`), runs and table (`study`), the
command."""
