"""Writes packing files (docs/cases.md) through the HDF5 library that crossgrain itself needs, so
that the tests need no Python package for it."""

import ctypes
import ctypes.util

_NAME = ctypes.util.find_library("hdf5_serial") or ctypes.util.find_library("hdf5")
_HDF5 = ctypes.CDLL(_NAME or "libhdf5_serial.so")
_HDF5.H5open()

_Id = ctypes.c_int64
_DOUBLE = _Id.in_dll(_HDF5, "H5T_NATIVE_DOUBLE_g")
_TRUNCATE = ctypes.c_uint(2)  # H5F_ACC_TRUNC
_DEFAULT = _Id(0)  # H5P_DEFAULT, and H5S_ALL
for _function in ("H5Fcreate", "H5Screate_simple", "H5Dcreate2"):
    getattr(_HDF5, _function).restype = _Id


def _check(value):
    if value < 0:
        raise OSError("HDF5 call failed")
    return value


def write_packing(file, **datasets):
    """A dataset is a list of numbers or of pairs."""
    handle = _Id(_check(_HDF5.H5Fcreate(str(file).encode(), _TRUNCATE, _DEFAULT, _DEFAULT)))
    for name, rows in datasets.items():
        pairs = bool(rows) and not isinstance(rows[0], float)
        values = [value for row in rows for value in row] if pairs else rows
        extent = (ctypes.c_uint64 * 2)(len(rows), 2)
        space = _Id(_check(_HDF5.H5Screate_simple(2 if pairs else 1, extent, None)))
        dataset = _Id(
            _check(
                _HDF5.H5Dcreate2(
                    handle, name.encode(), _DOUBLE, space, _DEFAULT, _DEFAULT, _DEFAULT
                )
            )
        )
        data = (ctypes.c_double * len(values))(*values)
        _check(_HDF5.H5Dwrite(dataset, _DOUBLE, _DEFAULT, _DEFAULT, _DEFAULT, data))
        _HDF5.H5Dclose(dataset)
        _HDF5.H5Sclose(space)
    _check(_HDF5.H5Fclose(handle))
    return file
