"""The text before it is spoken: tokens, sentences, and the spoken form of written text."""
