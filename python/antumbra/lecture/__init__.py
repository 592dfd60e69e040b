"""The lecture on direct illumination: experiments that are rendered, measured and put on one page.

A figure is one file of `figures/`; docs/lecture.md says how to add one. `make.Lecture` is what runs them.
"""
