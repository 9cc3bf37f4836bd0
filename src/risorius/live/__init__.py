"""A face for someone who talks for as long as it lasts: text arrives in pieces, frames leave one by one."""
