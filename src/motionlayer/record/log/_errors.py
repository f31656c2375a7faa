class LogError(Exception):
    """Message files cannot be written; the text says which, why and the way out."""
