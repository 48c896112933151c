"""Makes the Python package: see pyproject.toml."""
