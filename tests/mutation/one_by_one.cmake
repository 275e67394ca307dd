# Read by mutate.py's own build, at the end of the top folder: what is mutated is compiled one source at a time, so that
# a mutant costs one. Tests and the other libraries come out of a compiler cache as they are; so does studies/, of whose 160
# sources few are mutated: one at a time they take longer than they save.
cmake_language(DEFER CALL set_target_properties
               box2d_granular crossgrain_averaging crossgrain_oracle crossgrain_stability crossgrain_adapters crossgrain_cases
               PROPERTIES UNITY_BUILD OFF)
