// Timing on a machine with other load: many short repetitions, each a whole number of rounds over the states. The
// result of a run is the median over the repetitions.
#pragma once
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <string>
#include <vector>

// Keeps the compiler from omitting stores that nothing reads.
inline void observed() { asm volatile("" ::: "memory"); }

// Nanoseconds per call of `call(state index)`: the median over 300 repetitions of about 0.15 ms.
template <class Call> double nanoseconds(size_t states, Call &&call) {
  using clock = std::chrono::steady_clock;
  auto batch = [&](long rounds) {
    auto start = clock::now();
    for (long round = 0; round < rounds; ++round)
      for (size_t state = 0; state < states; ++state) call(state);
    return std::chrono::duration<double, std::nano>(clock::now() - start).count();
  };
  long rounds = 1;
  batch(rounds);
  while (batch(rounds) < 150e3 && rounds < (1L << 20)) rounds *= 2;
  std::vector<double> figures;
  for (int i = 0; i < 300; ++i) figures.push_back(batch(rounds) / (double(rounds) * double(states)));
  std::sort(figures.begin(), figures.end());
  return figures[figures.size() / 2];
}

// Prints one line of results: the program, the robot, the function, the time, and, if the function computes
// torques, the largest relative difference from the torques in the robot's data.
inline void report(const char *peer, const std::string &robot, const char *function, double ns,
                   double error = -1) {
  std::printf("{\"peer\": \"%s\", \"robot\": \"%s\", \"function\": \"%s\", \"ns\": %.2f", peer,
              robot.c_str(), function, ns);
  if (error >= 0) std::printf(", \"error\": %.2e", error);
  std::printf("}\n");
  std::fflush(stdout);
}
