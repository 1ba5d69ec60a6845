"""What the tests and the benchmarks share: a running server, a browser, a websocket client."""
