"""Making room: which files of ended runs may go, what that would free, and letting them go."""
