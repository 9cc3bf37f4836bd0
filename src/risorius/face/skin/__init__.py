"""The skin: a network of springs that bulges and folds."""
