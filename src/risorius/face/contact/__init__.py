"""Surfaces that touch: lips, lids and teeth."""
