"""The figures, one file each; a file is found by its folder and has one `FIGURE`."""
