"""The text before it is spoken: tokens, sentences, and what is read aloud in place of what is written."""
