"""``python -m playground`` is the command ``playground``."""

import sys


def main() -> int:
    """Run the command line; Ctrl-C ends it without a traceback, also while libraries load."""
    stopped: list[int] = []
    try:
        import signal

        def stop(number: int, frame: object) -> None:
            stopped.append(number)
            raise KeyboardInterrupt

        if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
            signal.signal(signal.SIGINT, stop)
        from playground import cli

        return cli.main()
    except KeyboardInterrupt:
        pass
    except Exception:  # NumPy turns a stop of its import into an error of its own
        if not stopped:
            raise
    print("playground: stopped", file=sys.stderr)
    return 130


if __name__ == "__main__":
    sys.exit(main())
