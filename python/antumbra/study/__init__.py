"""Error against rays and seconds: statistics, plots, and studies of a scene."""
