"""How functions may end, and what else they may do: exceptions, loops, locks."""
