"""What is lit: frozen values, files, the library of setups."""
