"""Our pictures beside the references that another renderer made of the same scenes."""
