"""The tab Motion of one browser: motions and work cycles, controllers compared, maps; and what is played."""
