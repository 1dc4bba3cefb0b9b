"""What the callables of libraries do: tables, and what the other rooms ask of them."""
