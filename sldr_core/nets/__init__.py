"""Networks, running normalisers, and what an agent sees: the parts that agents and streams are made of."""
