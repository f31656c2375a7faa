"""`python -m motionlayer`, the same as the command `motionlayer`."""

from motionlayer.cli import main

if __name__ == "__main__":
    main()
