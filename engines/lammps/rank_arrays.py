"""What a rank saw (Engine.part) as arrays of the protocol, and back."""

import numpy as np

# Components of each; all others are of vectors in the plane.
COLUMNS = {"ids": 1, "spin": 1, "torque": 1, "pairs": 5}


def as_arrays(part):
    return {name: ("i32" if name == "ids" else "f64", values) for name, values in part.items()}


def from_arrays(arrays):
    part = {}
    for name, values in arrays.items():
        columns = COLUMNS.get(name, 2)
        part[name] = np.reshape(values, (-1, columns)) if columns > 1 else values
    return part
