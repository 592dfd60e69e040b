"""What figures measure in their pictures: plain functions from arrays to quantities, one subject a file."""
