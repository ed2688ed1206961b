// The source of tests_precompiled, whose precompiled header the programs of tests share.
