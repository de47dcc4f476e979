// Cost of a rig's hierarchy by the size, depth and breadth of its tree.
//
// Claims, for the worst row of each table:
//  - reading an element of a tree that was not written since takes the same time among 100 elements and
//    among a million;
//  - setting the root and reading a leaf is linear in the leaf's depth from 10 to 100 000 levels, up to
//    cache effects, and does not depend on the number of other elements;
//  - setting and reading a leaf costs the same among 100 000 elements as among 1 000;
//  - a set without propagation, followed by reading the children's locals, is linear in the number of
//    children, and does not depend on what is below them.
#include "measure.hpp"
#include "tendril/rig/hierarchy.hpp"

namespace {

using namespace tendril::bench;
using namespace tendril::rig;

Transform step(double along) {
    return {.translation = {0.0, along, 0.0}, .rotation = normalised({1.0, 0.0, 1e-3, 0.0})};
}
ElementId add(Hierarchy& tree, ElementId parent) {
    return *tree.add(ElementKind::Bone, parent, step(0.1));
}

/// Every element above the last level has ten children.
struct Bush {
    Hierarchy tree;
    std::vector<ElementId> elements;
    explicit Bush(std::size_t size) {
        for (std::size_t i = 0; i < size; ++i)
            elements.push_back(add(tree, i == 0 ? ElementId{} : elements[(i - 1) / 10]));
        tree.resolve_all();
    }
};

/// A line of that depth, with `beside` siblings beside each element but the first.
struct Line {
    Hierarchy tree;
    ElementId root, leaf;
    Line(std::size_t depth, std::size_t beside) {
        root = leaf = add(tree, {});
        for (std::size_t i = 1; i < depth; ++i) {
            const ElementId parent = leaf;
            leaf = add(tree, parent);
            for (std::size_t j = 0; j < beside; ++j) add(tree, parent);
        }
        tree.resolve_all();
    }
    void set_and_read() {
        tree.put(root, Space::Global, step(1.0));
        tree.get(leaf, Space::Global);
    }
};

/// A root with that many children, each with `below` of its own.
struct Fan {
    Hierarchy tree;
    ElementId root;
    Fan(std::size_t children, std::size_t below) {
        root = add(tree, {});
        for (std::size_t i = 0; i < children; ++i) {
            const ElementId child = add(tree, root);
            for (std::size_t j = 0; j < below; ++j) add(tree, child);
        }
        tree.resolve_all();
    }
    void set_and_read() {
        tree.put(root, Space::Global, step(1.0), Propagate::No);
        for (ElementId child = tree.first_child(root); child; child = tree.next_sibling(child))
            tree.get(child, Space::Local);
    }
};

struct Row {
    std::string title;
    std::size_t parts;  ///< the time is divided by this
    double nanoseconds = 0.0;
};

/// Measures all rows of a table in turn, each with as many calls as make a fixed number of parts.
template <class Subject, class Call>
void measure(const char* title, std::vector<Row>& rows, std::vector<Subject>& subjects, Call run,
             const std::source_location& where = std::source_location::current()) {
    constexpr std::size_t parts = 50'000;  // some milliseconds
    std::vector<std::function<void()>> runs;
    std::vector<std::size_t> times;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const std::size_t count = std::max<std::size_t>(1, parts / rows[i].parts);
        times.push_back(count);
        runs.push_back([&run, &subject = subjects[i], count] {
            for (std::size_t j = 0; j < count; ++j) run(subject);
        });
    }
    const std::vector<double> seconds = race(
        runs, 31, cpu_seconds, [] {}, where);
    std::printf("%s\n", title);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        rows[i].nanoseconds =
            seconds[i] * 1e9 / static_cast<double>(times[i]) / static_cast<double>(rows[i].parts);
        std::printf("  %-40s%10.1f ns\n", rows[i].title.c_str(), rows[i].nanoseconds);
    }
}

/// The ratio of the cheapest row to the most expensive; 1: equal.
double evenness(const std::vector<Row>& rows) {
    const auto [least, most] = std::minmax_element(
        rows.begin(), rows.end(), [](const Row& a, const Row& b) { return a.nanoseconds < b.nanoseconds; });
    return least->nanoseconds / most->nanoseconds;
}

bool clean_reads() {
    std::vector<Row> rows;
    std::vector<Bush> bushes;
    for (const std::size_t size : {100u, 1'000u, 10'000u, 100'000u, 1'000'000u}) {
        rows.push_back({std::to_string(size) + " elements", 1});
        bushes.emplace_back(size);
    }
    measure("Reading a leaf of a tree in which nothing was written", rows, bushes,
            [](Bush& bush) { bush.tree.get(bush.elements.back(), Space::Global); });
    return claim("a clean read: cheapest tree over dearest", evenness(rows), 0.6);
}

bool depth_and_breadth() {
    std::vector<Row> rows;
    std::vector<Line> lines;
    for (const std::size_t depth : {10u, 100u, 1'000u, 10'000u, 100'000u}) {
        rows.push_back({std::to_string(depth) + " levels, for each", depth});
        lines.emplace_back(depth, 0);
    }
    measure("Setting the root and reading the leaf at the end of a line", rows, lines,
            std::mem_fn(&Line::set_and_read));
    bool all = claim("root and leaf: cheapest level over dearest", evenness(rows), 0.4);

    rows.clear();
    lines.clear();
    for (const std::size_t beside : {0u, 1u, 10u, 100u, 1000u}) {
        rows.push_back({std::to_string(beside) + " siblings at each level", 1});
        lines.emplace_back(100, beside);
    }
    measure("The same 100 levels deep", rows, lines, std::mem_fn(&Line::set_and_read));
    return claim("root and leaf: cheapest breadth over dearest", evenness(rows), 0.6) && all;
}

bool one_leaf() {
    std::vector<Row> rows;
    std::vector<Bush> bushes;
    for (const std::size_t size : {1'000u, 10'000u, 100'000u}) {
        rows.push_back({std::to_string(size) + " elements", 1});
        bushes.emplace_back(size);
    }
    measure("Setting a leaf's local and reading its global", rows, bushes, [](Bush& bush) {
        bush.tree.put(bush.elements.back(), Space::Local, step(0.2));
        bush.tree.get(bush.elements.back(), Space::Global);
    });
    return claim("one leaf: cheapest tree over dearest", evenness(rows), 0.6);
}

bool children_that_stay() {
    std::vector<Row> rows;
    std::vector<Fan> fans;
    for (const std::size_t children : {10u, 100u, 1'000u, 10'000u, 100'000u}) {
        rows.push_back({std::to_string(children) + " children, for each", children});
        fans.emplace_back(children, 0);
    }
    measure("Setting a global, not propagating, and reading the children's locals", rows, fans,
            std::mem_fn(&Fan::set_and_read));
    bool all = claim("children that stay: cheapest each over dearest", evenness(rows), 0.4);

    rows.clear();
    fans.clear();
    for (const std::size_t below : {0u, 1u, 10u, 100u, 1'000u}) {
        rows.push_back({"100 children with " + std::to_string(below) + " below each", 1});
        fans.emplace_back(100, below);
    }
    measure("The same", rows, fans, std::mem_fn(&Fan::set_and_read));
    return claim("children that stay: cheapest subtree over dearest", evenness(rows), 0.6) && all;
}

}  // namespace

int main(int count, char** arguments) {
    bool all = clean_reads();
    all &= depth_and_breadth();
    all &= one_leaf();
    all &= children_that_stay();
    return all || !has_flag(count, arguments, "--check") ? 0 : 1;
}
