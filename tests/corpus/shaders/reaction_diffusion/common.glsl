const float kFeed = 0.037, kKill = 0.06;
