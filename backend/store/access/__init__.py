"""Who may use the service: accounts, links, sessions, tokens, and what was done with them."""
