"""What radiosity trades light between: patches, how they are cut, refined and looked over."""
