"""Who may do what over HTTP: who asks, which role a route needs, and what is written down about it."""
