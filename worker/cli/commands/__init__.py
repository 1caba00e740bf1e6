"""The commands of `sldr`, one module each, with a `main(arguments) -> exit code`."""
