#include "core/tree/grow/colonise.h"

#include "core/tree/grow/clearance.h"
#include "core/tree/grow/reshape.h"

#include <algorithm>
#include <utility>

namespace ramus::tree::growth {

namespace {

// Tuned on the look of trees of 100 to 30,000 branches.
constexpr double kSpread = 0.74;           // least distance of terminals, in units of (volume / terminals)^(1/3)
constexpr double kAirAroundSegments = 0.4; // of that distance: how near a terminal may come to a vessel's wall
constexpr double kShortest = 0.16;         // of that distance: the shortest segment
constexpr double kLongest = 1.8;           // of that distance: the longest segment of a new terminal
constexpr double kStout = 0.9;             // nor is a segment shorter than this many of its radii
constexpr std::size_t kCandidates = 18;    // segments tried for each terminal
constexpr double kBackward = -0.25;        // least cosine between a child and its parent's way
constexpr double kTrunkTurn = 0.3;         // the same for the child that takes more blood than the other
constexpr double kTerritory = 0.35;        // of that distance: how deep below the capsule a new terminal lies
constexpr double kSkin = 1.5;              // of the capsule's thickness: how deep below the surface its wall lies
constexpr double kFavourPeers = 0.12; // a twig on a trunk of n times its width costs 1 + kFavourPeers (n - 1) times
constexpr double kFavourShort = 0.5;  // a terminal's segment longer than the distance costs this much extra
constexpr double kGridSlack = 1.5;    // radii grow between two renewals of the grid
constexpr int kPatience = 40;         // failed throws before the required distance is reduced

constexpr int kLastMiss = 4000; // throws in a row after which nothing fits; 250 were seen to be needed
constexpr int kLastSweeps = 4;
constexpr int kRepairs = 40;
constexpr int kFirstTerminals = 4; // as many as the organ's own trunks end in

double blood(double width) { return width * width; } // volume per length, up to a factor

// The point with the least sum of weighted distances to `ends`, by Weiszfeld's iteration from `start`.
Vec cheapest_fork(Vec start, std::span<const Vec> ends, std::span<const double> weights, int iterations) {
    for (int step = 0; step < iterations; ++step) {
        Vec sum(0.0);
        double total = 0.0;
        for (std::size_t i = 0; i < ends.size(); ++i) {
            const double pull = weights[i] / (glm::length(ends[i] - start) + 1e-9);
            sum += pull * ends[i];
            total += pull;
        }
        start = sum / total;
    }
    return start;
}

struct Candidate {
    int segment = -1;
    Vec fork{0.0};
    double cost = 0.0;
};

class Colony {
public:
    Colony(const Organ& organ, double root_radius_mm, Random& random)
        : organ_(organ), random_(random), segments_(organ.low(), organ.high(), spacing_for(1)),
          terminals_(organ.low(), organ.high(), spacing_for(1)), clearance_(organ, tree_, segments_) {
        tree_.root_radius_mm = root_radius_mm;
    }

    Result<Skeleton> run(int branches, const std::function<std::vector<int>(const Skeleton&)>& misplaced, Job& job);

private:
    [[nodiscard]] double spacing_for(int terminals) const {
        return kSpread * cube_root(organ_.volume_mm3() / terminals);
    }
    void plant(int terminals);
    [[nodiscard]] bool grow_to(int terminals, Job& job);
    [[nodiscard]] Vec anywhere_inside();
    [[nodiscard]] bool is_free(const Vec& point, double width);
    [[nodiscard]] bool attach(const Vec& point, double flow);
    [[nodiscard]] bool propose(int segment, const Vec& point, double width, Candidate& candidate) const;
    void join(const Candidate& candidate, const Vec& point, double flow);
    void relax();
    void relax_fork(int node);
    void renew();
    void renew_upstream_costs();
    void insert_segment(int node);
    void cut_out(const std::vector<int>& segments);

    const Organ& organ_;
    Random& random_;
    Skeleton tree_;
    SegmentGrid segments_;
    SegmentGrid terminals_;
    Clearance clearance_;
    std::vector<double> upstream_cost_; // extra blood in all segments above a node for one more unit of flow through it
    std::vector<int> near_;
    std::vector<Candidate> candidates_;
    int terminal_count_ = 0;
    double spacing_mm_ = 0.0;
    double ease_ = 1.0; // share of the distance between terminals that is asked for at present
};

void Colony::plant(int terminals) {
    tree_.add(organ_.root(), -1, 1.0);
    tree_.add(organ_.hilum(), kRoot, 1.0);
    terminal_count_ = 1;
    // The portal vein's own first forks, as far as there are terminals for them.
    for (const Organ::Trunk& trunk : organ_.trunks()) {
        if (terminal_count_ == terminals) break;
        const int from = kHilum + 1 + trunk.from;
        tree_.add(trunk.end, from, 1.0);
        if (tree_.at(from).child_count == 2) ++terminal_count_;
    }
    tree_.settle_flows();
    renew();
}

void Colony::insert_segment(int node) {
    segments_.insert(node, tree_.at(tree_.at(node).parent).position, tree_.at(node).position,
                     kGridSlack * tree_.radius_mm(node));
}

// Grids with cells that suit the present spacing, radii that suit the present flows.
void Colony::renew() {
    spacing_mm_ = spacing_for(terminal_count_);
    segments_ = SegmentGrid(organ_.low(), organ_.high(), spacing_mm_);
    terminals_ = SegmentGrid(organ_.low(), organ_.high(), spacing_mm_);
    for (int id = 1; id < tree_.size(); ++id) {
        insert_segment(id);
        if (tree_.at(id).child_count == 0) terminals_.insert(id, tree_.at(id).position, tree_.at(id).position, 0.0);
    }
    renew_upstream_costs();
}

void Colony::renew_upstream_costs() {
    upstream_cost_.assign(tree_.nodes.size(), 0.0);
    for (const int id : tree_.from_root())
        if (id != kRoot)
            upstream_cost_[static_cast<std::size_t>(id)] =
                upstream_cost_[static_cast<std::size_t>(tree_.at(id).parent)] +
                2.0 / 3.0 * tree_.length_mm(id) / tree_.at(id).width;
}

// Far enough from the other terminals and from every vessel's wall, deep enough below the capsule?
bool Colony::is_free(const Vec& point, double width) {
    const double radius = width * tree_.radius_scale();
    const double spacing = ease_ * spacing_mm_;
    if (organ_.depth_mm(point) < std::max(radius + kSkin * organ_.capsule_mm(), kTerritory * spacing)) return false;
    terminals_.query(point, point, spacing, near_);
    for (const int id : near_)
        if (glm::length(tree_.at(id).position - point) < spacing) return false;
    const double air = kAirAroundSegments * spacing + radius;
    segments_.query(point, point, air, near_);
    for (const int id : near_) {
        const Vec& start = tree_.at(tree_.at(id).parent).position;
        if (closest_approach(point, point, start, tree_.at(id).position).distance < air + tree_.radius_mm(id))
            return false;
    }
    return true;
}

// The best fork on one segment for a terminal at `point`, if it would look like one.
bool Colony::propose(int segment, const Vec& point, double width, Candidate& candidate) const {
    const Node& below = tree_.at(segment);
    const Vec& start = tree_.at(below.parent).position;
    const Vec& end = below.position;
    const double flow = width * width * width;
    const double trunk_width = cube_root(below.flow + flow);
    const double scale = tree_.radius_scale();
    const double least_above = std::max(kStout * scale * trunk_width, kShortest * spacing_mm_);
    const double least_below = std::max(kStout * scale * below.width, kShortest * spacing_mm_);
    const double length = glm::length(end - start);
    if (length < least_above + least_below) return false;

    const Vec ends[]{start, end, point};
    const double weights[]{blood(trunk_width), blood(below.width), blood(width)};
    const Vec first =
        (weights[0] * start + weights[1] * end + weights[2] * point) / (weights[0] + weights[1] + weights[2]);
    Vec fork = cheapest_fork(first, ends, weights, 10);
    if (glm::length(fork - start) < least_above || glm::length(fork - end) < least_below) {
        // The best point is too near an end: the best on the segment that is not, a little towards the terminal.
        double along = glm::dot(fork - start, end - start) / length;
        along = std::clamp(along, 1.05 * least_above, std::max(1.05 * least_above, length - 1.05 * least_below));
        fork = start + (end - start) * (along / length);
        fork += 0.08 * (point - fork);
        if (glm::length(fork - start) < least_above || glm::length(fork - end) < least_below) return false;
    }
    const double reach = glm::length(point - fork);
    if (reach < scale * trunk_width + kAirAroundSegments * ease_ * spacing_mm_ || reach > kLongest * spacing_mm_)
        return false;

    const Vec in = direction(start, fork);
    const Vec on = direction(fork, end);
    const Vec off = direction(fork, point);
    if (glm::dot(on, off) > kNarrowFork || glm::dot(in, off) < kBackward ||
        glm::dot(in, on) < (below.flow > flow ? kTrunkTurn : kBackward))
        return false;

    candidate.segment = segment;
    candidate.fork = fork;
    // With blood volume as the only cost, too many long twigs would begin at the trunk.
    const double bare = (1.0 + kFavourPeers * (trunk_width / width - 1.0)) * (1.0 + kFavourShort * reach / spacing_mm_);
    candidate.cost = weights[0] * glm::length(fork - start) + weights[1] * (glm::length(end - fork) - length) +
                     weights[2] * reach * bare + flow * upstream_cost_[static_cast<std::size_t>(below.parent)];
    return true;
}

bool Colony::attach(const Vec& point, double flow) {
    const double width = cube_root(flow);
    for (double reach = 1.6 * spacing_mm_;; reach *= 1.7) {
        segments_.query(point, point, reach, near_);
        if (near_.size() >= 8 || reach > glm::length(organ_.high() - organ_.low())) break;
    }
    std::vector<std::pair<double, int>> nearest;
    for (const int id : near_) {
        if (id == kHilum) continue; // the stem stays bare
        const Vec& start = tree_.at(tree_.at(id).parent).position;
        const double distance = closest_approach(point, point, start, tree_.at(id).position).distance;
        nearest.emplace_back(distance - tree_.radius_mm(id), id);
    }
    std::sort(nearest.begin(), nearest.end());
    if (nearest.size() > kCandidates) nearest.resize(kCandidates);

    candidates_.clear();
    for (const auto& [distance, id] : nearest) {
        Candidate candidate;
        if (propose(id, point, width, candidate)) candidates_.push_back(candidate);
    }
    std::sort(candidates_.begin(), candidates_.end(), [](const Candidate& a, const Candidate& b) {
        return a.cost != b.cost ? a.cost < b.cost : a.segment < b.segment;
    });
    const double scale = tree_.radius_scale();
    for (const Candidate& candidate : candidates_) {
        const Node& below = tree_.at(candidate.segment);
        const Spoke spokes[]{
            {below.parent, tree_.at(below.parent).position, scale * cube_root(below.flow + flow)},
            {candidate.segment, below.position, scale * below.width},
            {-1, point, scale * width},
        };
        const int own[]{candidate.segment};
        if (!clearance_.fork_fits(candidate.fork, spokes, own)) continue;
        join(candidate, point, flow);
        return true;
    }
    return false;
}

void Colony::join(const Candidate& candidate, const Vec& point, double flow) {
    const int below = candidate.segment;
    const int above = tree_.at(below).parent;
    Node fork;
    fork.position = candidate.fork;
    fork.parent = above;
    fork.children[0] = below;
    fork.child_count = 1;
    fork.flow = tree_.at(below).flow;
    tree_.nodes.push_back(fork);
    const int id = tree_.size() - 1;
    auto& siblings = tree_.at(above).children;
    *std::find(siblings.begin(), siblings.end(), below) = id;
    tree_.at(below).parent = id;
    const int leaf = tree_.add(point, id, flow);
    for (int up = id; up >= 0; up = tree_.at(up).parent) {
        Node& node = tree_.at(up);
        node.flow += flow;
        node.width = cube_root(node.flow);
    }
    upstream_cost_.resize(tree_.nodes.size());
    for (const int node : {id, leaf})
        upstream_cost_[static_cast<std::size_t>(node)] =
            upstream_cost_[static_cast<std::size_t>(tree_.at(node).parent)] +
            2.0 / 3.0 * tree_.length_mm(node) / tree_.at(node).width;
    insert_segment(id);
    insert_segment(below);
    insert_segment(leaf);
    terminals_.insert(leaf, point, point, 0.0);
    ++terminal_count_;
}

// Moves one fork to the place with the least cost of its segments at the present flows, if it fits there.
void Colony::relax_fork(int id) {
    const Node& node = tree_.at(id);
    std::array<Vec, 4> ends;
    std::array<double, 4> weights;
    std::array<Spoke, 4> spokes;
    std::array<int, 4> own;
    std::size_t count = 0;
    const auto add = [&](int other, int segment) {
        ends[count] = tree_.at(other).position;
        weights[count] = blood(tree_.at(segment).width);
        spokes[count] = {other, ends[count], tree_.radius_mm(segment), segment == kHilum};
        own[count++] = segment;
    };
    add(node.parent, id);
    for (int c = 0; c < node.child_count; ++c) {
        const int child = node.children[static_cast<std::size_t>(c)];
        add(child, child);
    }
    const Vec best = cheapest_fork(node.position, std::span(ends.data(), count), std::span(weights.data(), count), 4);
    const Vec fork = node.position + 0.7 * (best - node.position);
    if (glm::length(fork - node.position) < 0.02 * spacing_mm_) return;

    const Vec in = direction(ends[0], fork);
    for (std::size_t i = 0; i < count; ++i) {
        const bool leaf = i > 0 && tree_.at(own[i]).child_count == 0;
        const double least = leaf ? spokes[0].radius_mm + kAirAroundSegments * spacing_mm_
                                  : std::max(kStout * spokes[i].radius_mm, kShortest * spacing_mm_);
        if (glm::length(ends[i] - fork) < least) return;
        const bool major = i > 0 && 2.0 * tree_.at(own[i]).flow > node.flow;
        if (i > 0 && glm::dot(in, direction(fork, ends[i])) < (major ? kTrunkTurn : kBackward)) return;
        for (std::size_t k = 1; k < i; ++k)
            if (glm::dot(direction(fork, ends[k]), direction(fork, ends[i])) > kNarrowFork) return;
    }
    if (!clearance_.fork_fits(fork, std::span(spokes.data(), count), std::span(own.data(), count))) return;
    tree_.at(id).position = fork;
    for (std::size_t i = 0; i < count; ++i) insert_segment(own[i]);
}

void Colony::relax() {
    for (int id = kHilum + 1; id < tree_.size(); ++id)
        if (tree_.at(id).child_count > 0) relax_fork(id);
}

void Colony::cut_out(const std::vector<int>& segments) {
    tree_ = without_segments(tree_, segments);
    terminal_count_ = 0;
    for (const Node& node : tree_.nodes) terminal_count_ += node.child_count == 0 ? 1 : 0;
    renew();
}

Result<Skeleton> Colony::run(int branches, const std::function<std::vector<int>(const Skeleton&)>& misplaced,
                             Job& job) {
    const int terminals = branches / 2 + 1;
    plant(terminals);
    for (int round = 0; round < kRepairs; ++round) {
        if (!grow_to(terminals, job)) {
            if (job.cancelled()) return fail("growing was cancelled");
            break;
        }
        for (int sweep = 0; round == 0 && sweep < kLastSweeps; ++sweep) {
            renew();
            relax();
        }
        if (tree_.size() - 1 > branches && !merge_one_fork(tree_, clearance_)) break;
        tree_.settle_flows();
        const std::vector<int> wrong = misplaced(tree_);
        if (wrong.empty()) return tree_;
        cut_out(wrong);
    }
    return fail("there is no room for " + std::to_string(branches) + " branches in this organ", {},
                "make the organ larger or the root's radius smaller");
}

// Adds terminals up to a number of them, then lets all forks settle. False: nothing fits, or cancelled.
bool Colony::grow_to(int terminals, Job& job) {
    int renew_at = 2 * terminal_count_;
    int refresh_at = terminal_count_ + 1;
    std::size_t sector = terminal_count_ <= kFirstTerminals ? 0 : organ_.sectors().size();
    int misses = 0;
    while (terminal_count_ < terminals) {
        if (job.cancelled() || misses > kLastMiss) return false;
        spacing_mm_ = spacing_for(terminal_count_ + 1);
        // A wide range of flows, small ones more often: terminals are not all alike.
        const double u = random_.unit();
        const double flow = 0.2 + 1.6 * u * u;
        Vec point(0.0);
        if (sector < organ_.sectors().size())
            point = organ_.sectors()[sector++];
        else
            point = anywhere_inside();
        if (!is_free(point, cube_root(flow)) || !attach(point, flow)) {
            if (++misses % kPatience == 0) ease_ = std::max(0.5, 0.97 * ease_);
            continue;
        }
        misses = 0;
        ease_ = std::min(1.0, ease_ * 1.002);
        if (terminal_count_ >= renew_at) {
            renew();
            relax();
            relax();
            renew();
            renew_at = 2 * terminal_count_;
        }
        if (terminal_count_ >= refresh_at) {
            renew_upstream_costs();
            refresh_at = terminal_count_ + 1 + terminal_count_ / 10;
        }
        if (terminal_count_ % 64 == 0)
            job.report(0.8F * static_cast<float>(terminal_count_) / static_cast<float>(terminals));
    }
    tree_.settle_flows();
    return true;
}

Vec Colony::anywhere_inside() {
    for (;;) {
        const double x = random_.unit();
        const double y = random_.unit();
        const double z = random_.unit();
        const Vec point = organ_.low() + (organ_.high() - organ_.low()) * Vec(x, y, z);
        if (organ_.depth_mm(point) > 0.0) return point;
    }
}

} // namespace

Result<Skeleton> colonise(const Organ& organ, double root_radius_mm, int branches, Random& random,
                          const std::function<std::vector<int>(const Skeleton&)>& misplaced, Job& job) {
    // Thick first trunks may block each other by chance; other random throws may not.
    constexpr int kAttempts = 4;
    for (int attempt = 1;; ++attempt) {
        Result<Skeleton> tree = Colony(organ, root_radius_mm, random).run(branches, misplaced, job);
        if (tree || job.cancelled() || attempt == kAttempts) return tree;
    }
}

} // namespace ramus::tree::growth
