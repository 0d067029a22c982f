"""Controllers to start from: each a script of one page, to be copied and changed."""
