// Nothing of its own: the target that it belongs to holds the precompiled headers of all others.
