"""LAMMPS' C library interface (library.h) through ctypes: the few calls that the worker needs."""

import ctypes

import numpy as np

SHARED = "liblammps.so.0"  # Debian's liblammps0, which the package lammps brings
LOCAL, ATOM = 2, 1  # styles of library.h
SCALAR, VECTOR, ARRAY, ROWS, COLUMNS = 0, 1, 2, 4, 5  # types


class Lammps:
    """One instance. An error within LAMMPS ends the process; its text is the last in the log.

    shared  the library: a descendant of LAMMPS may have the same interface
    options of its command line"""

    def __init__(self, shared=SHARED, options=(b"-nocite",)):
        self.library = ctypes.CDLL(shared)
        self.library.lammps_extract_compute.restype = ctypes.c_void_p
        self.library.lammps_extract_fix.restype = ctypes.c_void_p
        self.library.lammps_get_natoms.restype = ctypes.c_double
        arguments = [b"lammps", b"-log", b"none", *options]
        self.handle = ctypes.c_void_p()
        self.library.lammps_open_no_mpi(
            len(arguments),
            (ctypes.c_char_p * len(arguments))(*arguments),
            ctypes.byref(self.handle),
        )

    def version(self):
        return str(self.library.lammps_version(self.handle))

    def atoms(self):
        return int(self.library.lammps_get_natoms(self.handle))

    def command(self, line):
        self.library.lammps_command(self.handle, line.encode())

    def place(self):
        """This process' rank, and how many ranks share the run."""
        return tuple(
            self.library.lammps_extract_setting(self.handle, name)
            for name in (b"world_rank", b"world_size")
        )

    def close(self):
        self.library.lammps_close(self.handle)

    def end_mpi(self):
        """Once, last of all: mpirun takes a rank for broken that ends without."""
        self.library.lammps_mpi_finalize()

    def create_atoms(self, kind, position):
        """Atoms 1, 2, … of the given types at the rows of `position` (n, 3)."""
        n = len(kind)
        ids = np.arange(1, n + 1, dtype=np.int32)  # several ranks would number them in another order
        kind = np.ascontiguousarray(kind, np.int32)
        position = np.ascontiguousarray(position, float)
        made = self.library.lammps_create_atoms(
            self.handle,
            n,
            ids.ctypes.data_as(ctypes.c_void_p),
            kind.ctypes.data_as(ctypes.c_void_p),
            position.ctypes.data_as(ctypes.c_void_p),
            None,
            None,
            1,
        )
        if made != n:
            raise RuntimeError(f"LAMMPS took {made} of {n} atoms")

    def gather(self, name, components):
        """A quantity of all atoms in the order of their ids, (n, components) or (n,)."""
        n = self.atoms()
        values = np.empty((n, components))
        self.library.lammps_gather_atoms(
            self.handle, name.encode(), 1, components, values.ctypes.data_as(ctypes.c_void_p)
        )
        return values if components > 1 else values[:, 0]

    def own_count(self):
        """Atoms of this rank, without those that it only sees."""
        return self.library.lammps_extract_setting(self.handle, b"nlocal")

    def own(self, name):
        """A quantity of this rank's atoms in LAMMPS' own order, (n, 3): its memory, not a copy."""
        n = self.own_count()
        if n == 0:
            return np.empty((0, 3))
        self.library.lammps_extract_atom.restype = ctypes.c_void_p
        rows = ctypes.cast(
            self.library.lammps_extract_atom(self.handle, name.encode()),
            ctypes.POINTER(ctypes.POINTER(ctypes.c_double)),
        )
        return np.ctypeslib.as_array(rows[0], (n, 3))  # rows follow each other in memory

    def scatter(self, name, values):
        values = np.ascontiguousarray(values, float)
        components = values.shape[1] if values.ndim > 1 else 1
        self.library.lammps_scatter_atoms(
            self.handle, name.encode(), 1, components, values.ctypes.data_as(ctypes.c_void_p)
        )

    def count_of_compute(self, name):
        """Rows of a local compute, which is made anew where its step is over."""
        pointer = self.library.lammps_extract_compute(self.handle, name.encode(), LOCAL, ROWS)
        return ctypes.cast(pointer, ctypes.POINTER(ctypes.c_int))[0]

    def local_compute(self, name, columns):
        """The array of a local compute, (rows, columns), copied."""
        rows = self.count_of_compute(name)
        if rows == 0:
            return np.empty((0, columns))
        pointer = self.library.lammps_extract_compute(self.handle, name.encode(), LOCAL, ARRAY)
        array = ctypes.cast(pointer, ctypes.POINTER(ctypes.POINTER(ctypes.c_double)))
        return np.ctypeslib.as_array(array[0], (rows, columns)).copy()

    def fix_array(self, name, columns):
        """The first columns of a fix's array of this rank's atoms, in LAMMPS' own order."""
        n = self.own_count()
        pointer = self.library.lammps_extract_fix(self.handle, name.encode(), ATOM, ARRAY, 0, 0)
        rows = ctypes.cast(pointer, ctypes.POINTER(ctypes.POINTER(ctypes.c_double)))
        return np.array([rows[atom][:columns] for atom in range(n)]).reshape(n, columns)

    def ids(self):
        """Of this rank's atoms in LAMMPS' own order, which changes as it sorts them."""
        n = self.own_count()
        self.library.lammps_extract_atom.restype = ctypes.c_void_p
        pointer = self.library.lammps_extract_atom(self.handle, b"id")
        ids = ctypes.cast(pointer, ctypes.POINTER(ctypes.c_int))
        return np.ctypeslib.as_array(ids, (n,)).copy() if n else np.empty(0, np.int32)
