"""Drawings that single figures show beside their pictures: plain functions from numbers to a `Drawing`."""
