"""The strict reader of TOML and JSON: the dataclass is the schema, errors say where."""
