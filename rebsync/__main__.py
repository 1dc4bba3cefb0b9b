"""`rebsync` and `python -m rebsync`; an interrupt while modules are loaded ends in order."""

import sys


def main() -> int:
    """Run the command line; what it returns is the exit status."""
    try:
        from rebsync.cli import main as run

        return run()
    except KeyboardInterrupt:
        sys.stderr.write("interrupted\n")
        return 130


if __name__ == "__main__":
    raise SystemExit(main())
