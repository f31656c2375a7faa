class TraceError(Exception):
    """A trace cannot be read, written or drawn; the text says which, why, where and the way out."""
