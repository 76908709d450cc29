// How long the distances of all vertices of one mesh to the triangles of another take, its search tree included: one
// line of JSON, for scripts/bench-distances.
#include "core/io/meshes/mesh_file.h"
#include "core/measure/deviation/deviation.h"

#include <chrono>
#include <ctime>
#include <iostream>
#include <numeric>

int main(int count, char** words) {
    if (count != 3) {
        std::cerr << "usage: ramus_bench_distance A.ply B.ply\n";
        return 2;
    }
    const auto surface = ramus::io::read_mesh(words[1]);
    const auto other = ramus::io::read_mesh(words[2]);
    if (!surface || !other) {
        std::cerr << (surface ? other : surface).error().message() << '\n';
        return 1;
    }
    const auto begin = std::chrono::steady_clock::now();
    const std::clock_t begin_cpu = std::clock();
    const auto distances = ramus::measure::deviations(*surface, *other, 0);
    const double cpu = double(std::clock() - begin_cpu) / CLOCKS_PER_SEC;
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    const double sum = std::accumulate(distances.begin(), distances.end(), 0.0);
    std::cout << "{\"vertices\": " << distances.size() << ", \"triangles\": " << other->triangles.size()
              << ", \"seconds\": " << seconds << ", \"cpu_seconds\": " << cpu
              << ", \"mean_mm\": " << sum / static_cast<double>(distances.size()) << "}\n";
    return 0;
}
