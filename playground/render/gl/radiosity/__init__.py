"""Radiosity on the GPU: form factors."""
