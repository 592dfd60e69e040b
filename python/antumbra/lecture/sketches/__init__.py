"""Drawings, frames and panels that single figures show: plain functions from numbers to parts of a stage."""
