"""Studies: named sets of runs, tasks x methods x seeds, launched together and read together."""
