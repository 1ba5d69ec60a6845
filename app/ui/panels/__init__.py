"""One panel a file. A panel knows the session, never another panel."""
