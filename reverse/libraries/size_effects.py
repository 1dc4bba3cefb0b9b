"""What functions of the standard libraries do to the sizes of containers, by their names.

The names stand for methods and functions of C++ and of Python alike: one that only one of the two
has does no harm in the other.
"""

from __future__ import annotations

# Methods that give what is there at the time when it is asked for.
VIEWS = frozenset({"items", "keys", "values", "elements", "__iter__"})
# What changes sizes of its object, or of what it gets, and has no size in the table of outcomes.
CHANGING_OBJECT = frozenset(
    {
        *("append", "swap", "splice", "merge", "replace", "resize", "assign", "emplace_hint"),
        *("__setitem__", "__iadd__", "__imul__", "__ior__", "symmetric_difference_update"),
        *("insert_after", "emplace_after", "push_range", "append_range", "insert_range"),
    }
)
CHANGING_ARGUMENTS = frozenset(
    {
        *("heappush", "heappop", "insort", "insort_left", "insort_right", "swap", "exchange"),
        *("back_inserter", "front_inserter", "inserter", "getline", "erase", "erase_if", "setitem"),
        *("iadd", "iconcat"),
    }
)
# Methods that leave their object as it is, and those that only take elements out of it.
READING = VIEWS | frozenset(
    {
        *("size", "length", "empty", "begin", "end", "cbegin", "cend", "rbegin", "rend", "crend"),
        *("front", "back", "at", "find", "rfind", "count", "contains", "substr", "c_str", "data"),
        *("capacity", "reserve", "max_size", "compare", "top", "lower_bound", "upper_bound"),
        *("get", "index", "copy", "sort", "reverse", "rotate", "startswith", "endswith", "split"),
        *("strip", "upper", "lower", "join", "format", "encode", "isdigit", "starts_with"),
        *("ends_with", "fill", "operator[]", "find_first_of", "crbegin", "equal_range"),
    }
)
LESSENING = frozenset(
    {
        *("pop", "popleft", "popitem", "remove", "discard", "clear", "erase", "pop_back"),
        *("pop_front", "shrink_to_fit"),
    }
)
# Functions and methods of C++ that lead to nothing where they find nothing, or behind the last
# element; to the first or last one, if there is one; and to one from where their argument leads.
SEARCHING = frozenset(
    {
        *("find", "find_if", "find_if_not", "lower_bound", "upper_bound", "search", "lock"),
        *(
            "adjacent_find",
            "getenv",
            "dynamic_pointer_cast",
            "dynamic_cast",
            "get_if",
            "end",
            "cend",
            "rend",
            "crend",
        ),
    }
)
# Methods of smart pointers that leave these without an object; `reset` does without an argument.
RELEASING = frozenset({"reset", "release", "swap"})
SWAPPING = frozenset({"swap", "exchange"})  # what they get by its address may lead elsewhere
LEADING_TO_FIRST = frozenset({"begin", "cbegin", "rbegin", "crbegin", "data"})
MAKING = frozenset({"make_unique", "make_shared", "allocate_shared", "make_optional", "new"})
# Functions of C that look at a text, which must be there.
TAKING_TEXTS = frozenset(
    {
        *("strlen", "strcmp", "strncmp", "strcpy", "strncpy", "strcat", "strdup", "strstr"),
        *("strchr", "strrchr", "atoi", "atol", "atof", "strtol", "strtoul", "strtod", "fopen"),
        *("puts", "fputs"),
    }
)
BINDING = frozenset({"bind"})  # functions that give one which runs another later
LEADING_ON = frozenset({"max_element", "min_element", "next", "prev"})
