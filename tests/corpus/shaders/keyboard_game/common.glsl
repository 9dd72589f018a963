const ivec2 kPlace = ivec2(0, 0), kShots = ivec2(1, 0);
