"""How generated nodes are joined: facts of today and of the base go in; odd ones come out."""
