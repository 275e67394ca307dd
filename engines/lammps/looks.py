"""What a rank saw (Engine.look) as arrays of the protocol, and back."""

import numpy as np

# Components of each; all others are of vectors in the plane.
COLUMNS = {"ids": 1, "spin": 1, "torque": 1, "pairs": 5}


def as_arrays(look):
    return {name: ("i32" if name == "ids" else "f64", values) for name, values in look.items()}


def from_arrays(arrays):
    look = {}
    for name, values in arrays.items():
        columns = COLUMNS.get(name, 2)
        look[name] = np.reshape(values, (-1, columns)) if columns > 1 else values
    return look
