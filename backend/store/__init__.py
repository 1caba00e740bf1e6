"""The only code that speaks SQL: settings, tables, the run state machine, the queue, metrics and files."""
