"""Bytes on the wire, as PROTOCOL.md has them: frames, messages, numbers of states and settings."""
