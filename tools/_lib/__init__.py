"""What the commands in tools/ share: one idea a module."""
