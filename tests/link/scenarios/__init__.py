"""Things that happen to a robot on a cable, each told in one small file, played against the real firmware."""
