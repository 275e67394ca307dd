"""What workers of engines that know disks, walls and a Coulomb law answer alike."""

EFFECTS = (
    "normal_damping",
    "friction",
    "tangential_spring",
    "tangential_damping",
    "rotation",
    "gravity",
    "moving_walls",
)


def effects_without_bottom():
    """Of `capabilities`: all effects of disks in their plane can be had, the bottom plate's never."""
    never = ("bottom_friction", "bottom_spin_friction")
    return {name: "optional" for name in EFFECTS} | {name: "never" for name in never}


def setting(name, default, unit, doc):
    """Of `capabilities`: a setting that takes any number."""
    return {"name": name, "default": default, "unit": unit, "doc": doc, "choices": []}


def effects_called(law, scene):
    """Of `load`: which of EFFECTS a scene calls for. law has gn, kt and gt as they act, and friction."""
    called = (
        law.gn > 0,
        law.friction,
        law.kt > 0,
        law.gt > 0,
        law.friction and scene["rotation"],
        any(scene["gravity"]),
        any(body["motion"]["kind"] != "fixed" for body in scene["bodies"]),
    )
    return [name for name, calls in zip(EFFECTS, called) if calls]
