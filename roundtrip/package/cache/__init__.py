"""Values kept between runs: a key and a value go in; the value comes out in a later run."""
