#include "tendril/rope/edit.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <utility>

#include "math/checks.hpp"
#include "rope/body_data.hpp"
#include "rope/build.hpp"
#include "rope/rest_grid.hpp"
#include "rope/slots.hpp"

namespace tendril::rope {
namespace {

using glm::dvec3;
using tendril::detail::refused;

using detail::BodyData;

template <class T>
void replace_range(std::vector<T>& list, std::size_t first, std::size_t count, const std::vector<T>& by) {
    const auto from = list.begin() + static_cast<std::ptrdiff_t>(first);
    const auto at = list.erase(from, from + static_cast<std::ptrdiff_t>(count));
    list.insert(at, by.begin(), by.end());
}

Expected<Edited> edited(State state, std::vector<std::size_t> becomes) {
    Expected<World> world = World::from_state(std::move(state));
    if (!world) return world.error();
    return Edited{.world = *std::move(world), .becomes = std::move(becomes)};
}

/// A point on a row of particles: `part` of the way from particle `before` to the next.
struct RowPoint {
    std::size_t before = 0;
    double part = 0.0;
    std::size_t after() const noexcept { return part > 0.0 ? before + 1 : before; }
    std::size_t nearest() const noexcept { return part < 0.5 ? before : before + 1; }
};

/// Distributes `segments` over the spans in proportion to their lengths, at least one to each.
std::vector<std::size_t> distribute_segments(const std::vector<double>& lengths, std::size_t segments) {
    double total = 0.0;
    for (const double length : lengths) total += length;
    std::vector<std::size_t> counts;
    std::vector<std::pair<double, std::size_t>> missing;  // shortfall of each span
    std::size_t given = 0;
    for (std::size_t i = 0; i < lengths.size(); ++i) {
        const double wanted = static_cast<double>(segments) * lengths[i] / total;
        counts.push_back(static_cast<std::size_t>(std::max(1.0, std::floor(wanted + 1e-9))));
        given += counts.back();
        missing.emplace_back(wanted - static_cast<double>(counts.back()), i);
    }
    const auto more = [](const auto& a, const auto& b) {
        return a.first != b.first ? a.first > b.first : a.second < b.second;
    };
    std::sort(missing.begin(), missing.end(), more);
    for (std::size_t i = 0; given < segments; i = (i + 1) % missing.size())
        ++counts[missing[i].second], ++given;
    while (given > segments) {
        const auto largest = std::max_element(counts.begin(), counts.end());
        --*largest, --given;
    }
    return counts;
}

/// Where to sample a row's new particles. `rest`: its old particles' coordinates; `kept`: particles that
/// stay, in order, with both ends.
std::vector<RowPoint> sample_row(const std::vector<double>& rest, const std::vector<std::size_t>& kept,
                                 std::size_t segments) {
    std::vector<double> lengths;
    const bool extended = rest.back() > 0.0;
    const auto at = [&](std::size_t i) { return extended ? rest[i] : static_cast<double>(i); };
    for (std::size_t i = 0; i + 1 < kept.size(); ++i) lengths.push_back(at(kept[i + 1]) - at(kept[i]));
    const std::vector<std::size_t> counts = distribute_segments(lengths, segments);
    std::vector<RowPoint> list;
    for (std::size_t span = 0; span < counts.size(); ++span) {
        std::size_t before = kept[span];
        for (std::size_t k = 0; k < counts[span]; ++k) {
            const double wanted =
                at(kept[span]) + lengths[span] * static_cast<double>(k) / static_cast<double>(counts[span]);
            while (before + 1 < kept[span + 1] && at(before + 1) <= wanted) ++before;
            const double step = at(before + 1) - at(before);
            double part = k == 0 || !(step > 0.0) ? 0.0 : (wanted - at(before)) / step;
            if (part < 1e-6) part = 0.0;
            list.push_back(part > 1.0 - 1e-6 ? RowPoint{before + 1, 0.0} : RowPoint{before, part});
        }
    }
    list.push_back({kept.back(), 0.0});
    return list;
}

std::vector<std::size_t> nearest_samples(const std::vector<RowPoint>& list, std::size_t count) {
    std::vector<std::size_t> becomes;
    const auto where = [&](std::size_t i) { return static_cast<double>(list[i].before) + list[i].part; };
    for (std::size_t i = 0, at = 0; i < count; ++i) {
        const auto number = static_cast<double>(i);
        while (at + 1 < list.size() && std::abs(where(at + 1) - number) <= std::abs(where(at) - number)) ++at;
        becomes.push_back(at);
    }
    return becomes;
}

class Resampling {
  public:
    Resampling(const State& state, const Body& body, const Resolution& to)
        : state_(state),
          body_(body),
          was_(resolution(body)),
          to_(to),
          grid_(detail::rest_grid(state, body)),
          particle_(was_.columns * was_.rows, body.count),
          pin_(particle_.size(), nullptr) {
        for (std::size_t i = 0; i < body.count; ++i) particle_[body.cell(i)] = i;
        for (const Pin& pin : state.pins)
            if (pin.particle - body.first < body.count) pin_[body.cell(pin.particle - body.first)] = &pin;
        find_threads();
    }

    Result divide_rows() {
        const auto axis = [&](bool across, std::vector<RowPoint>& list) -> Result {
            const std::size_t was = across ? was_.rows : was_.columns, to = across ? to_.rows : to_.columns;
            if (was == to) {
                for (std::size_t i = 0; i < was; ++i) list.push_back({i, 0.0});
                return {};
            }
            const std::vector<std::size_t> kept = fixed_indices(across);
            if (to < kept.size()) {
                char rule[128];
                std::snprintf(rule, sizeof rule,
                              "%zu or more, %zu segments: its ends, ties and single pins keep particles",
                              kept.size(), kept.size() - 1);
                return refused("resample", across ? "rows" : "columns", rule, to);
            }
            list = sample_row(across ? grid_.down : grid_.along, kept, to - 1);
            return {};
        };
        if (const Result bad = axis(false, column_); !bad) return bad;
        return axis(true, row_);
    }

    /// `becomes`: the new particle of each old one, or the nearest to it.
    BodyData taken(std::vector<std::size_t>& becomes) const {
        BodyData made{.row = to_.columns};
        std::vector<std::size_t> number(to_.columns * to_.rows, none);
        add_particles(made, number);
        add_links(made, number);
        conserve_momentum(made);
        map_particles(number, becomes);
        return made;
    }

  private:
    static constexpr std::size_t none = ~std::size_t{0};

    void map_particles(const std::vector<std::size_t>& number, std::vector<std::size_t>& becomes) const {
        const std::vector<std::size_t> columns = nearest_samples(column_, was_.columns),
                                       rows = nearest_samples(row_, was_.rows);
        const auto off = [](std::size_t a, std::size_t b) { return a < b ? b - a : a - b; };
        for (std::size_t i = 0; i < body_.count; ++i) {
            const std::size_t cell = body_.cell(i), c = columns[cell % was_.columns],
                              r = rows[cell / was_.columns];
            std::size_t at = r * to_.columns + c;
            if (number[at] == none) {  // a gap: the nearest particle around it
                std::size_t least = none;
                for (std::size_t k = 0; k < number.size(); ++k) {
                    const std::size_t far = off(k % to_.columns, c) + off(k / to_.columns, r);
                    if (number[k] != none && far < least) least = far, at = k;
                }
            }
            becomes.push_back(number[at]);
        }
    }

    /// Finds the stretch links. Only cloth may lack some.
    void find_threads() {
        along_.assign(pin_.size(), nullptr), down_.assign(pin_.size(), nullptr);
        for (const Link& link : state_.links) {
            if (!detail::is_within(body_, link)) continue;
            example_link_[static_cast<std::size_t>(link.kind)] = &link;
            if (link.kind != Link::Kind::Stretch) continue;
            const detail::LinkStep step = detail::link_step(body_, link);
            const std::size_t begin = step.row * was_.columns + step.column;
            if (step.columns == 1 && step.rows == 0) along_[begin] = &link;
            if (step.columns == 0 && step.rows == 1) down_[begin] = &link;
        }
    }

    bool same_pin(std::size_t a, std::size_t b) const {
        return pin_[a] != nullptr && pin_[b] != nullptr && pin_[a]->collider == pin_[b]->collider;
    }

    /// The columns, or rows, that must stay: the ends, those with ties, and those with a pin that does not
    /// continue on both sides.
    std::vector<std::size_t> fixed_indices(bool across) const {
        const std::size_t count = across ? was_.rows : was_.columns, step = across ? was_.columns : 1;
        std::vector<bool> kept(count, false);
        kept.front() = kept.back() = true;
        const auto number = [&](std::size_t i) { return across ? i / was_.columns : i % was_.columns; };
        for (std::size_t i = 0; i < pin_.size(); ++i) {
            const std::size_t at = number(i);
            if (pin_[i] == nullptr || at == 0 || at + 1 == count) continue;
            if (!same_pin(i, i - step) || !same_pin(i, i + step)) kept[at] = true;
        }
        for (const Tie& tie : state_.ties)
            for (const std::uint32_t each : {tie.a, tie.b})
                if (each - body_.first < body_.count) kept[number(body_.cell(each - body_.first))] = true;
        std::vector<std::size_t> list;
        for (std::size_t i = 0; i < count; ++i)
            if (kept[i]) list.push_back(i);
        return list;
    }

    std::size_t old_cell(std::size_t column, std::size_t row) const { return row * was_.columns + column; }

    /// Whether a cell gets a new particle: the nearest old cell has one, and threads lead to it.
    bool filled(std::size_t c, std::size_t r) const {
        if (body_.cells.empty()) return true;
        return particle_[old_cell(column_[c].nearest(), row_[r].nearest())] < body_.count &&
               ((c > 0 && is_whole(c - 1, r, c, r)) || (r > 0 && is_whole(c, r - 1, c, r)) ||
                (c + 1 < to_.columns && is_whole(c, r, c + 1, r)) ||
                (r + 1 < to_.rows && is_whole(c, r, c, r + 1)));
    }

    /// Whether the cloth is whole between two of the new particles, which may be one.
    bool is_whole(std::size_t c0, std::size_t r0, std::size_t c1, std::size_t r1) const {
        const auto low_c = std::min(column_[c0].before, column_[c1].before),
                   high_c = std::max(column_[c0].after(), column_[c1].after()),
                   low_r = std::min(row_[r0].before, row_[r1].before),
                   high_r = std::max(row_[r0].after(), row_[r1].after());
        for (std::size_t r = low_r; r <= high_r; ++r)
            for (std::size_t c = low_c; c <= high_c; ++c) {
                if (c < high_c && along_[old_cell(c, r)] == nullptr) return false;
                if (r < high_r && down_[old_cell(c, r)] == nullptr) return false;
            }
        return true;
    }

    dvec3 blend(const std::vector<dvec3>& list, std::size_t c, std::size_t r) const {
        const RowPoint &column = column_[c], &row = row_[r];
        const auto at = [&](std::size_t i, std::size_t k) {
            return list[body_.first + particle_[old_cell(i, k)]];
        };
        if (!is_whole(c, r, c, r)) return at(column.nearest(), row.nearest());
        const auto in_row = [&](std::size_t k) {
            const dvec3 before = at(column.before, k);
            return column.part > 0.0 ? before + column.part * (at(column.before + 1, k) - before) : before;
        };
        const dvec3 before = in_row(row.before);
        return row.part > 0.0 ? before + row.part * (in_row(row.before + 1) - before) : before;
    }

    /// The pin of a new particle; none unless all old particles around it are pinned alike.
    bool pin_at(std::size_t c, std::size_t r, Pin& pin) const {
        const RowPoint &column = column_[c], &row = row_[r];
        const std::size_t corners[] = {
            old_cell(column.before, row.before), old_cell(column.after(), row.before),
            old_cell(column.before, row.after()), old_cell(column.after(), row.after())};
        const double parts[] = {(1.0 - column.part) * (1.0 - row.part), column.part * (1.0 - row.part),
                                (1.0 - column.part) * row.part, column.part * row.part};
        if (pin_[corners[0]] == nullptr) return false;
        pin = *pin_[corners[0]];
        if (corners[0] == corners[3]) return true;
        pin.goal = dvec3(0.0);
        for (std::size_t i = 0; i < 4; ++i) {
            if (!same_pin(corners[0], corners[i])) return false;
            pin.goal += parts[i] * pin_[corners[i]]->goal;
            pin.seconds = std::max(pin.seconds, pin_[corners[i]]->seconds);
        }
        return true;
    }

    /// Rest coordinates of the new columns, or rows.
    static std::vector<double> coordinates(const std::vector<double>& was,
                                           const std::vector<RowPoint>& list) {
        std::vector<double> all;
        for (const RowPoint& each : list)
            all.push_back(was[each.before] + each.part * (was[each.after()] - was[each.before]));
        return all;
    }

    /// Sets the number of the particle in each cell.
    void add_particles(BodyData& made, std::vector<std::size_t>& number) const {
        const bool cloth = body_.kind == Body::Kind::Cloth;
        const double end = cloth ? 1.0 : 0.5;
        const std::vector<double> columns = detail::lumped_lengths(coordinates(grid_.along, column_), end),
                                  rows = detail::lumped_lengths(coordinates(grid_.down, row_), end);
        double all = 0.0;  // sum over all filled cells, or over a strand
        for (std::size_t r = 0; r < (cloth ? to_.rows : 1); ++r)
            for (std::size_t c = 0; c < to_.columns; ++c)
                if (filled(c, r)) all += columns[c] * (cloth ? rows[r] : 1.0);
        for (std::size_t r = 0; r < to_.rows; ++r) {
            double mass = 0.0;  // kg in all rows of a cloth, or in this strand
            for (std::size_t i = 0; i < body_.count; ++i)
                if (cloth || i / was_.columns == r) mass += state_.mass[body_.first + i];
            const double unit = mass / all;
            for (std::size_t c = 0; c < to_.columns; ++c) {
                if (!filled(c, r)) continue;
                const std::size_t cell = r * to_.columns + c;
                number[cell] = made.position.size();
                if (!body_.cells.empty()) made.cells.push_back(static_cast<std::uint32_t>(cell));
                made.position.push_back(blend(state_.position, c, r));
                made.displacement.push_back(blend(state_.displacement, c, r));
                made.mass.push_back(std::clamp(unit * columns[c] * (cloth ? rows[r] : 1.0), 1e-30, 1e30));
                Pin pin;
                if (!pin_at(c, r, pin)) continue;
                pin.particle = number[cell];
                made.pins.push_back(pin);
            }
        }
    }

    void add_links(BodyData& made, const std::vector<std::size_t>& number) const {
        detail::RestGrid grid{.along = coordinates(grid_.along, column_),
                              .down = coordinates(grid_.down, row_),
                              .cosine = grid_.cosine};
        Body body = body_;
        body.first = 0, body.count = number.size(), body.row = to_.columns, body.cells.clear();
        const auto columns = static_cast<std::uint32_t>(to_.columns),
                   rows = static_cast<std::uint32_t>(to_.rows);
        const Link* const stretch = example_link_[static_cast<std::size_t>(Link::Kind::Stretch)];
        const double per = stretch != nullptr ? detail::unit_link_compliance(body_, grid_, *stretch) : 0.0;
        const double material = per > 0.0 ? stretch->compliance / per : 0.0;
        // Each thread of a cloth carries a share of the force.
        const auto share = [](std::size_t was, std::size_t now) {
            return static_cast<double>(was) / static_cast<double>(now);
        };
        const auto add = [&](std::uint32_t a, std::uint32_t b, Link::Kind kind) {
            const std::size_t ca = a % columns, ra = a / columns, cb = b % columns, rb = b / columns;
            const Link* const like = example_link_[static_cast<std::size_t>(kind)];
            if (like == nullptr || !is_whole(ca, ra, cb, rb)) return;
            Link link{.a = a, .b = b, .rest = 0.0f, .kind = kind, .compliance = like->compliance};
            link.rest = static_cast<float>(detail::length(grid.at(cb, rb) - grid.at(ca, ra)));
            if (kind == Link::Kind::Stretch) {
                const double soft = material * detail::unit_link_compliance(body, grid, link);
                link.compliance = static_cast<float>(std::min(soft, static_cast<double>(max_magnitude)));
                const bool in_row = ra == rb;
                const Link& under = *(in_row ? along_[old_cell(column_[ca].before, row_[ra].nearest())]
                                             : down_[old_cell(column_[ca].nearest(), row_[ra].before)]);
                link.tension = static_cast<float>(
                    under.tension * (in_row ? share(was_.rows, to_.rows) : share(was_.columns, to_.columns)));
            }
            link.a = static_cast<std::uint32_t>(number[a]), link.b = static_cast<std::uint32_t>(number[b]);
            made.links.push_back(link);
        };
        detail::each_link(body_.kind, columns, rows, add);
    }

    /// Adds the same velocity to all free particles, so that their momentum stays the same.
    void conserve_momentum(BodyData& made) const {
        dvec3 missing(0.0);
        for (std::size_t i = 0; i < body_.count; ++i)
            if (pin_[body_.cell(i)] == nullptr)
                missing += state_.mass[body_.first + i] * state_.displacement[body_.first + i];
        std::vector<bool> pinned(made.position.size(), false);
        for (const Pin& pin : made.pins) pinned[pin.particle] = true;
        double mass = 0.0;
        for (std::size_t i = 0; i < pinned.size(); ++i) {
            if (pinned[i]) continue;
            missing -= made.mass[i] * made.displacement[i];
            mass += made.mass[i];
        }
        if (!(mass > 0.0)) return;
        for (std::size_t i = 0; i < pinned.size(); ++i)
            if (!pinned[i]) made.displacement[i] += (1.0 / mass) * missing;
    }

    const State& state_;
    const Body& body_;
    Resolution was_, to_;
    detail::RestGrid grid_;
    // For each cell of its grid.
    std::vector<std::size_t> particle_;      ///< numbered in the body; body_.count: none
    std::vector<const Pin*> pin_;            ///< null: none
    std::vector<const Link*> along_, down_;  ///< the stretch links that begin there
    const Link* example_link_[3] = {};       ///< a link of each kind
    std::vector<RowPoint> column_, row_;
};

}  // namespace

std::size_t Body::particle_in(std::size_t cell) const noexcept {
    if (cells.empty()) return std::min(cell, count);
    const auto found = std::lower_bound(cells.begin(), cells.end(), cell);
    return found == cells.end() || *found != cell ? count : static_cast<std::size_t>(found - cells.begin());
}

void detail::replace_body(State& state, BodyId id, const BodyData& taken,
                          const std::vector<std::size_t>& becomes) {
    Body& body = *detail::find_in(state.bodies, id);
    const std::size_t first = body.first, was = body.count, end = first + was, now = taken.position.size();
    replace_range(state.position, first, was, taken.position);
    replace_range(state.displacement, first, was, taken.displacement);
    replace_range(state.mass, first, was, taken.mass);
    const auto number = [&](std::size_t particle) {
        return static_cast<std::uint32_t>(particle < end ? particle : particle - was + now);
    };

    std::vector<Link> links;
    bool placed = false;
    const auto place = [&] {
        for (Link link : taken.links) {
            link.a += static_cast<std::uint32_t>(first), link.b += static_cast<std::uint32_t>(first);
            links.push_back(link);
        }
        placed = true;
    };
    for (Link link : state.links) {
        const bool own = detail::owns(body, link);
        if (!placed && (own || link.a >= end)) place();
        if (own) continue;
        link.a = number(link.a), link.b = number(link.b);
        links.push_back(link);
    }
    if (!placed) place();
    state.links = std::move(links);

    std::erase_if(state.pins, [&](const Pin& pin) { return pin.particle - first < was; });
    for (Pin& pin : state.pins) pin.particle = number(pin.particle);
    for (Pin pin : taken.pins) {
        pin.particle += first;
        state.pins.push_back(pin);
    }
    std::sort(state.pins.begin(), state.pins.end(),
              [](const Pin& a, const Pin& b) { return a.particle < b.particle; });
    for (Tie& tie : state.ties)
        for (std::uint32_t* each : {&tie.a, &tie.b})
            *each = *each - first < was ? static_cast<std::uint32_t>(first + becomes[*each - first])
                                        : number(*each);
    const auto changed = [&](std::uint32_t particle) { return particle - first < was; };
    std::erase_if(state.contacts,
                  [&](const BodyContact& each) { return changed(each.a) || changed(each.b); });
    for (BodyContact& each : state.contacts) each.a = number(each.a), each.b = number(each.b);
    for (Body& each : state.bodies)
        if (each.first >= end) each.first = each.first - was + now;
    body.count = now;
    body.row = taken.row;
    body.cells = taken.cells;
    measure_stretch(state, body);
}

void detail::measure_stretch(const State& state, Body& body) noexcept {
    double worst = 0.0;
    for (const Link& link : state.links)
        if (owns(body, link)) worst = std::max(worst, length_error(state, link));
    body.stretch = static_cast<float>(std::min(worst, static_cast<double>(max_magnitude)));
}

void detail::crop(Body& body) {
    if (body.cells.empty()) return;
    const auto row = static_cast<std::uint32_t>(body.row), top = body.cells.front() / row;
    std::uint32_t left = row, right = 0;
    for (const std::uint32_t cell : body.cells)
        left = std::min(left, cell % row), right = std::max(right, cell % row);
    body.row = right - left + 1;
    const auto now = static_cast<std::uint32_t>(body.row);
    for (std::uint32_t& cell : body.cells) cell = (cell / row - top) * now + cell % row - left;
    if (body.cells.back() + 1 == body.count && body.count % body.row == 0) body.cells.clear();
}

Resolution resolution(const Body& body) noexcept {
    return {.columns = body.row, .rows = body.rows()};
}

Expected<Edited> resample(const World& world, BodyId id, const Resolution& to) {
    const char* const op = "resample";
    const Body* const body = world.find(id);
    if (body == nullptr) return detail::missing(op, "body", id, world.state());
    const bool cloth = body->kind == Body::Kind::Cloth;
    const Resolution was = resolution(*body);
    const std::size_t others = world.size() - body->count;
    if (body->count < 2) return refused(op, "body", "longer than 0", "a single particle");
    const auto check = [&](const char* name, std::size_t from, std::size_t into, bool stays) -> Result {
        if (stays ? into == from : into >= 2) return {};
        return refused(op, name, stays ? "as many as there are" : "2 or more", into);
    };
    // A piece of cloth may be a single thread.
    if (const Result bad = check("columns", was.columns, to.columns, was.columns == 1); !bad) return bad;
    if (const Result bad = check("rows", was.rows, to.rows, !cloth || was.rows == 1); !bad) return bad;
    if (to.rows > max_particles || to.columns > (max_particles - others) / to.rows)
        return refused(op, "particles", "at most 1000000 in all", to.columns);
    if (to == was) {
        std::vector<std::size_t> same(body->count);
        for (std::size_t i = 0; i < same.size(); ++i) same[i] = i;
        return Edited{.world = world, .becomes = std::move(same)};
    }
    Resampling resampling(world.state(), *body, to);
    if (const Result bad = resampling.divide_rows(); !bad) return bad;
    State state = world.state();
    std::vector<std::size_t> becomes;
    const BodyData taken = resampling.taken(becomes);
    if (taken.position.empty())
        return refused(op, "columns", "more: nothing of it would be left", to.columns);
    detail::replace_body(state, id, taken, becomes);
    Body& now = *detail::find_in(state.bodies, id);
    const bool gaps = !now.cells.empty();
    detail::crop(now);
    Expected<Edited> made = edited(std::move(state), std::move(becomes));
    if (!made || !gaps) return made;
    Expected<Edited> apart = part_body(made->world, id);
    for (std::size_t& each : made->becomes) each = apart->becomes[each];
    apart->becomes = std::move(made->becomes);
    return apart;
}

Expected<Edited> reverse(const World& world, BodyId rope) {
    const Body* const body = world.find(rope);
    if (body == nullptr) return detail::missing("reverse", "rope", rope, world.state());
    if (body->kind != Body::Kind::Rope)
        return Result(ErrorCode::InvalidArgument, "only ropes have ends to swap, not cloth or hair");
    State state = world.state();
    const std::size_t first = body->first, last = body->count - 1;
    std::vector<std::size_t> becomes(body->count);
    BodyData taken{.row = body->count};
    for (std::size_t i = 0; i <= last; ++i) {
        const std::size_t from = first + last - i;
        becomes[i] = last - i;
        taken.position.push_back(state.position[from]);
        taken.displacement.push_back(state.displacement[from]);
        taken.mass.push_back(state.mass[from]);
    }
    for (auto link = state.links.rbegin(); link != state.links.rend(); ++link) {
        if (!detail::owns(*body, *link)) continue;
        Link turned = *link;
        turned.a = static_cast<std::uint32_t>(becomes[link->b - first]);
        turned.b = static_cast<std::uint32_t>(becomes[link->a - first]);
        taken.links.push_back(turned);
    }
    for (Pin pin : state.pins) {
        if (pin.particle - first > last) continue;
        pin.particle = becomes[pin.particle - first];
        taken.pins.push_back(pin);
    }
    detail::replace_body(state, rope, taken, becomes);
    return edited(std::move(state), std::move(becomes));
}

}  // namespace tendril::rope
