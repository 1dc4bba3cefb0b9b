"""Which files belong to a package, and what of them matters."""
