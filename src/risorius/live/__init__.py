"""A live face that talks while it lasts: text arrives in pieces, frames leave one by one."""
