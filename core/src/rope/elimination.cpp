#include "rope/elimination.hpp"

#include <algorithm>
#include <array>
#include <set>

namespace tendril::rope::detail {
namespace {

/// Inverts by L D L^T, which keeps digits beside a stiff link that cofactors would lose.
Symmetric3 stable_inverse(const Symmetric3& a) noexcept {
    const double d0 = 1.0 / a.xx, l10 = a.xy * d0, l20 = a.xz * d0;
    const double d1 = 1.0 / (a.yy - l10 * a.xy), c21 = a.yz - l20 * a.xy, l21 = c21 * d1;
    const double d2 = 1.0 / (a.zz - l20 * a.xz - l21 * c21);
    // Rows of the inverse of L.
    const double i20 = l10 * l21 - l20;
    return {d0 + l10 * l10 * d1 + i20 * i20 * d2,
            -l10 * d1 - i20 * l21 * d2,
            i20 * d2,
            d1 + l21 * l21 * d2,
            -l21 * d2,
            d2};
}

/// a b
Matrix3 product(const Matrix3& a, const Symmetric3& b) noexcept {
    Matrix3 c;
    for (int r = 0; r < 3; ++r) {
        const double x = a.m[3 * r], y = a.m[3 * r + 1], z = a.m[3 * r + 2];
        c.m[3 * r] = x * b.xx + y * b.xy + z * b.xz;
        c.m[3 * r + 1] = x * b.xy + y * b.yy + z * b.yz;
        c.m[3 * r + 2] = x * b.xz + y * b.yz + z * b.zz;
    }
    return c;
}

double row_dot(const Matrix3& a, int i, const Matrix3& b, int j) noexcept {
    return a.m[3 * i] * b.m[3 * j] + a.m[3 * i + 1] * b.m[3 * j + 1] + a.m[3 * i + 2] * b.m[3 * j + 2];
}

}  // namespace

Elimination::Elimination(std::span<const std::uint8_t> is_late, std::span<const Edge> edges)
    : rank(is_late.size(), 0) {
    const auto nodes = static_cast<std::uint32_t>(is_late.size());
    std::vector<std::vector<std::uint32_t>> beside(nodes);  // ascending
    const auto join = [&](std::uint32_t a, std::uint32_t b) {
        const auto at = std::lower_bound(beside[a].begin(), beside[a].end(), b);
        if (at == beside[a].end() || *at != b) beside[a].insert(at, b);
    };
    for (const Edge& edge : edges) join(edge.first, edge.second), join(edge.second, edge.first);
    std::set<std::array<std::uint32_t, 3>> left;  // late, neighbours, node
    const auto key = [&](std::uint32_t node) {
        return std::array{std::uint32_t{is_late[node]}, static_cast<std::uint32_t>(beside[node].size()),
                          node};
    };
    for (std::uint32_t node = 0; node < nodes; ++node) left.insert(key(node));
    std::vector<std::vector<std::uint32_t>> columns;
    columns.reserve(nodes);
    while (!left.empty()) {
        const std::uint32_t node = left.begin()->back();
        left.erase(left.begin());
        rank[node] = static_cast<std::uint32_t>(columns.size());
        columns.push_back(std::move(beside[node]));
        late += is_late[node] == 0 ? 1u : 0u;
        for (const std::uint32_t a : columns.back()) {
            left.erase(key(a));
            std::erase(beside[a], node);
            for (const std::uint32_t b : columns.back())
                if (a != b) join(a, b);
            left.insert(key(a));
        }
    }
    first.reserve(nodes + 1);
    for (std::vector<std::uint32_t>& column : columns) {
        first.push_back(static_cast<std::uint32_t>(row.size()));
        for (std::uint32_t& node : column) node = rank[node];
        std::sort(column.begin(), column.end());
        row.insert(row.end(), column.begin(), column.end());
    }
    first.push_back(static_cast<std::uint32_t>(row.size()));
    for (const std::vector<std::uint32_t>& column : columns)
        for (std::size_t i = 0; i < column.size(); ++i)
            for (std::size_t k = i + 1; k < column.size(); ++k) fill.push_back(block(column[i], column[k]));
}

std::uint32_t Elimination::block(std::uint32_t a, std::uint32_t b) const noexcept {
    const std::uint32_t column = std::min(a, b);
    const auto from = row.begin() + first[column], end = row.begin() + first[column + 1];
    return static_cast<std::uint32_t>(std::lower_bound(from, end, std::max(a, b)) - row.begin());
}

void EliminationSystem::resize(const Elimination& order) {
    diagonal.resize(order.rank.size());
    blocks.resize(order.row.size());
    x.resize(order.rank.size());
}

void EliminationSystem::clear() {
    std::fill(diagonal.begin(), diagonal.end(), Symmetric3{});
    std::fill(blocks.begin(), blocks.end(), Matrix3{});
    std::fill(x.begin(), x.end(), dvec3(0.0));
}

void EliminationSystem::factorize(const Elimination& order) noexcept {
    const std::uint32_t* changed = order.fill.data();
    const std::size_t count = diagonal.size();
    for (std::size_t j = 0; j < count; ++j) {
        const Symmetric3 inverse = diagonal[j] = stable_inverse(diagonal[j]);
        const std::uint32_t end = order.first[j + 1];
        for (std::uint32_t i = order.first[j]; i < end; ++i) {
            const Matrix3 was = blocks[i], part = product(was, inverse);
            Symmetric3& at = diagonal[order.row[i]];
            at.xx -= row_dot(part, 0, was, 0), at.xy -= row_dot(part, 0, was, 1);
            at.xz -= row_dot(part, 0, was, 2), at.yy -= row_dot(part, 1, was, 1);
            at.yz -= row_dot(part, 1, was, 2), at.zz -= row_dot(part, 2, was, 2);
            for (std::uint32_t k = i + 1; k < end; ++k) {
                Matrix3& to = blocks[*changed++];
                for (int r = 0; r < 3; ++r)
                    for (int c = 0; c < 3; ++c) to.m[3 * r + c] -= row_dot(blocks[k], r, part, c);
            }
            x[order.row[i]] -= part * x[j];
            blocks[i] = part;
        }
    }
}

void EliminationSystem::eliminate(const Elimination& order, std::vector<dvec3>& right,
                                  std::uint32_t from) const noexcept {
    for (std::size_t j = from; j < right.size(); ++j)
        for (std::uint32_t i = order.first[j]; i < order.first[j + 1]; ++i)
            right[order.row[i]] -= blocks[i] * right[j];
}

void EliminationSystem::substitute(const Elimination& order, std::vector<dvec3>& right,
                                   std::uint32_t to) const noexcept {
    for (std::size_t j = right.size(); j-- > to;) {
        dvec3 at = diagonal[j] * right[j];
        for (std::uint32_t i = order.first[j]; i < order.first[j + 1]; ++i)
            at -= blocks[i].transposed_by(right[order.row[i]]);
        right[j] = at;
    }
}

void DenseSystem::resize(std::size_t numbers) {
    size = numbers;
    matrix.resize(size * size);
}

/// L, by rows below the diagonal; L^T above it.
void DenseSystem::factorize(std::size_t n) noexcept {
    for (std::size_t i = 0; i < n; ++i) factorize_row(i);
}

double DenseSystem::factorize_row(std::size_t i) noexcept {
    double* const row = matrix.data() + i * size;
    const double diagonal = row[i];
    for (std::size_t k = 0; k < i; ++k) {  // first the entries of L, times D
        const double by = row[k], *const above = matrix.data() + k * size;
        for (std::size_t j = k + 1; j < i; ++j) row[j] -= by * above[j];
    }
    for (std::size_t k = 0; k < i; ++k) {
        const double part = row[k] / matrix[k * size + k];
        row[i] -= part * row[k];
        row[k] = matrix[k * size + i] = part;
    }
    return row[i] / diagonal;
}

void DenseSystem::drop_row(std::size_t i) noexcept {
    for (std::size_t k = 0; k < i; ++k) matrix[i * size + k] = matrix[k * size + i] = 0.0;
    matrix[i * size + i] = 1e30;
}

void DenseSystem::solve(double* x, std::size_t n) const noexcept {
    for (std::size_t k = 0; k < n; ++k) {
        const double by = x[k], *const above = matrix.data() + k * size;
        for (std::size_t i = k + 1; i < n; ++i) x[i] -= above[i] * by;
    }
    for (std::size_t i = 0; i < n; ++i) x[i] /= matrix[i * size + i];
    for (std::size_t k = n; k-- > 0;) {
        const double by = x[k], *const row = matrix.data() + k * size;
        for (std::size_t i = 0; i < k; ++i) x[i] -= row[i] * by;
    }
}

}  // namespace tendril::rope::detail
