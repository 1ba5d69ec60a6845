"""The firmware's core once more, in Python, for computers without a C compiler: written from PROTOCOL.md, and held
against the C by a test that gives both the same random lives."""
