"""What a paper that shows these figures may cite: the method, and the statistics."""

REFERENCES = r"""@misc{kilinc2019reinforcement,
  author        = {Kilinc, Ozsel and Montana, Giovanni},
  title         = {Reinforcement Learning for Robotic Manipulation using Simulated Locomotion Demonstrations},
  year          = {2019},
  eprint        = {1910.07294},
  archiveprefix = {arXiv},
}

@inproceedings{agarwal2021deep,
  author    = {Agarwal, Rishabh and Schwarzer, Max and Castro, Pablo Samuel and Courville, Aaron C. and
               Bellemare, Marc G.},
  title     = {Deep Reinforcement Learning at the Edge of the Statistical Precipice},
  booktitle = {Advances in Neural Information Processing Systems},
  year      = {2021},
}
"""
