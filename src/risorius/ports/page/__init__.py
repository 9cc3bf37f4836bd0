"""A page that plays a take by itself, and what the studio's page shares with it."""
