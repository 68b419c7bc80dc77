// Duff and Reid, The Multifrontal Solution of Indefinite Sparse Symmetric Linear Equations, 1983; Liu, The Multifrontal
// Method for Sparse Matrix Solution, 1992. Each supernode assembles its dense front from the matrix and from what its
// children left over, factorises its own columns and leaves the rest to its parent. Subtrees are independent and run in
// parallel; the few large fronts at the top are themselves split. Every sum has a fixed order.
#include "meshtween/solve/cholesky.h"

#include "meshtween/core/error.h"
#include "meshtween/core/parallel.h"
#include "meshtween/solve/supernodes.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <atomic>

namespace meshtween {
namespace {

using Block = Eigen::Map<Eigen::MatrixXd>;
using ConstBlock = Eigen::Map<const Eigen::MatrixXd>;

std::size_t at(int i) {
    return static_cast<std::size_t>(i);
}

// The lower triangle in the factor's order.
Eigen::SparseMatrix<double> permuted(const Eigen::SparseMatrix<double>& lower, const std::vector<int>& permutation) {
    std::vector<int> inverse(permutation.size());
    for (std::size_t k = 0; k < permutation.size(); ++k) inverse[at(permutation[k])] = static_cast<int>(k);
    std::vector<Eigen::Triplet<double>> triplets;
    triplets.reserve(static_cast<std::size_t>(lower.nonZeros()));
    for (int j = 0; j < lower.outerSize(); ++j)
        for (Eigen::SparseMatrix<double>::InnerIterator it(lower, j); it; ++it) {
            if (it.row() < j) continue;
            const int a = inverse[at(static_cast<int>(it.row()))], b = inverse[at(j)];
            triplets.emplace_back(std::max(a, b), std::min(a, b), it.value());
        }
    Eigen::SparseMatrix<double> result(lower.rows(), lower.cols());
    result.setFromTriplets(triplets.begin(), triplets.end());
    return result;
}

struct Factorisation {
    const Supernodes& nodes;
    const Eigen::SparseMatrix<double>& matrix;
    std::vector<std::vector<int>> children;
    std::vector<Eigen::MatrixXd> rest; // what a supernode leaves to its parent: lower triangle, a row a row below
    std::vector<double>& values;
    std::atomic<bool> definite{true};

    Block own(int s) const {
        return {values.data() + nodes.value_start[at(s)], static_cast<Eigen::Index>(nodes.rows_of(s).size()),
                nodes.columns(s)};
    }
};

void assemble(Factorisation& f, int s, Block own, Eigen::MatrixXd& rest) {
    const auto rows = f.nodes.rows_of(s);
    const int begin = f.nodes.first[at(s)], columns = f.nodes.columns(s);
    const auto place = [&](int row) {
        return row - begin < columns
                   ? row - begin
                   : static_cast<int>(std::lower_bound(rows.begin() + columns, rows.end(), row) - rows.begin());
    };
    for (int j = 0; j < columns; ++j)
        for (Eigen::SparseMatrix<double>::InnerIterator it(f.matrix, begin + j); it; ++it)
            own(place(static_cast<int>(it.row())), j) += it.value();
    std::vector<int> where;
    for (const int child : f.children[at(s)]) {
        Eigen::MatrixXd& update = f.rest[at(child)];
        const auto below = f.nodes.rows_of(child).subspan(at(f.nodes.columns(child)));
        where.clear();
        for (const int row : below) where.push_back(place(row));
        for (Eigen::Index j = 0; j < update.cols(); ++j) {
            const int column = where[static_cast<std::size_t>(j)];
            double* target = column < columns ? &own(0, column) : &rest(0, column - columns) - columns;
            for (Eigen::Index i = j; i < update.rows(); ++i) target[where[static_cast<std::size_t>(i)]] += update(i, j);
        }
        update.resize(0, 0);
    }
}

void factorise(Factorisation& f, int s) {
    Block own = f.own(s);
    const Eigen::Index columns = own.cols(), below = own.rows() - columns;
    own.setZero();
    Eigen::MatrixXd rest = Eigen::MatrixXd::Zero(below, below);
    assemble(f, s, own, rest);
    Eigen::Ref<Eigen::MatrixXd> corner = own.topRows(columns);
    const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> llt(corner);
    if (llt.info() != Eigen::Success) f.definite = false;
    if (below == 0 || !f.definite) return;
    constexpr Eigen::Index piece = 192;
    const Eigen::Index pieces = (below + piece - 1) / piece;
    parallel_for(
        pieces,
        [&](Eigen::Index p) {
            auto part = own.middleRows(columns + p * piece, std::min(piece, below - p * piece));
            corner.triangularView<Eigen::Lower>().transpose().solveInPlace<Eigen::OnTheRight>(part);
        },
        1);
    parallel_for(
        pieces,
        [&](Eigen::Index p) {
            const Eigen::Index begin = p * piece, width = std::min(piece, below - begin);
            const auto from = own.bottomRows(below - begin);
            rest.block(begin, begin, below - begin, width).noalias() -= from * from.topRows(width).transpose();
        },
        1);
    f.rest[at(s)] = std::move(rest);
}

// Independent subtrees of about equal work, by their roots; what lies above them is left.
std::vector<int> subtrees(const Supernodes& nodes, const std::vector<std::vector<int>>& children) {
    std::vector<double> work(at(nodes.count()), 0);
    double total = 0;
    for (int s = 0; s < nodes.count(); ++s) {
        const auto height = static_cast<double>(nodes.rows_of(s).size());
        const double own = height * height * nodes.columns(s);
        total += own;
        work[at(s)] += own;
        if (nodes.parent[at(s)] >= 0) work[at(nodes.parent[at(s)])] += work[at(s)];
    }
    std::vector<int> open, roots;
    for (int s = 0; s < nodes.count(); ++s)
        if (nodes.parent[at(s)] < 0) open.push_back(s);
    while (!open.empty()) {
        const int s = open.back();
        open.pop_back();
        if (work[at(s)] <= total / 32 || children[at(s)].empty())
            roots.push_back(s);
        else
            open.insert(open.end(), children[at(s)].begin(), children[at(s)].end());
    }
    std::sort(roots.begin(), roots.end());
    return roots;
}

} // namespace

struct SparseCholesky::Data {
    std::shared_ptr<const Supernodes> pattern;
    std::vector<double> values;
    Eigen::Index tallest = 0; // rows of the tallest block

    // A row a row of the matrix.
    template <typename Matrix>
    Matrix solve(const Matrix& right) const;
};

std::shared_ptr<const Supernodes> factor_pattern(const Eigen::SparseMatrix<double>& matrix) {
    return std::make_shared<const Supernodes>(supernodes(matrix));
}

SparseCholesky::SparseCholesky(const Eigen::SparseMatrix<double>& matrix, std::shared_ptr<const Supernodes> pattern) {
    auto data = std::make_unique<Data>();
    data->pattern = pattern ? std::move(pattern) : factor_pattern(matrix);
    const Supernodes& nodes = *data->pattern;
    data->values.resize(nodes.value_start.back());
    const Eigen::SparseMatrix<double> ordered = permuted(matrix, nodes.permutation);
    Factorisation f{nodes, ordered, std::vector<std::vector<int>>(at(nodes.count())),
                    std::vector<Eigen::MatrixXd>(at(nodes.count())), data->values};
    for (int s = 0; s < nodes.count(); ++s) {
        if (nodes.parent[at(s)] >= 0) f.children[at(nodes.parent[at(s)])].push_back(s);
        data->tallest = std::max(data->tallest, static_cast<Eigen::Index>(nodes.rows_of(s).size()));
    }
    const std::vector<int> roots = subtrees(nodes, f.children);
    std::vector<int> first_of(roots.size()); // a subtree is first_of..root, for supernodes are in postorder
    std::vector<char> done(at(nodes.count()), 0);
    for (std::size_t r = 0; r < roots.size(); ++r) {
        int s = roots[r];
        while (!f.children[at(s)].empty()) s = f.children[at(s)].front();
        first_of[r] = s;
        std::fill(done.begin() + s, done.begin() + roots[r] + 1, char{1});
    }
    parallel_for(
        static_cast<std::ptrdiff_t>(roots.size()),
        [&](std::ptrdiff_t r) {
            const auto i = static_cast<std::size_t>(r);
            for (int s = first_of[i]; s <= roots[i] && f.definite; ++s) factorise(f, s);
        },
        1);
    for (int s = 0; s < nodes.count() && f.definite; ++s)
        if (!done[at(s)]) factorise(f, s);
    if (!f.definite)
        throw Error(ErrorKind::computation, "the mesh gives a singular system: a part of it is not held anywhere");
    data_ = std::move(data);
}

SparseCholesky::~SparseCholesky() = default;
SparseCholesky::SparseCholesky(SparseCholesky&&) noexcept = default;
SparseCholesky& SparseCholesky::operator=(SparseCholesky&&) noexcept = default;

template <typename Matrix>
Matrix SparseCholesky::Data::solve(const Matrix& right) const {
    const Supernodes& nodes = *pattern;
    Matrix x(right.rows(), right.cols()), below(tallest, right.cols());
    for (Eigen::Index k = 0; k < x.rows(); ++k) x.row(k) = right.row(nodes.permutation[static_cast<std::size_t>(k)]);
    const auto block = [&](int s) {
        return ConstBlock(values.data() + nodes.value_start[at(s)], static_cast<Eigen::Index>(nodes.rows_of(s).size()),
                          nodes.columns(s));
    };
    for (int s = 0; s < nodes.count(); ++s) {
        const ConstBlock own = block(s);
        const auto rows = nodes.rows_of(s);
        const Eigen::Index columns = own.cols(), rest = own.rows() - columns;
        auto mine = x.middleRows(nodes.first[at(s)], columns);
        own.topRows(columns).triangularView<Eigen::Lower>().solveInPlace(mine);
        below.topRows(rest).noalias() = own.bottomRows(rest) * mine;
        for (Eigen::Index i = 0; i < rest; ++i) x.row(rows[static_cast<std::size_t>(columns + i)]) -= below.row(i);
    }
    for (int s = nodes.count() - 1; s >= 0; --s) {
        const ConstBlock own = block(s);
        const auto rows = nodes.rows_of(s);
        const Eigen::Index columns = own.cols(), rest = own.rows() - columns;
        auto mine = x.middleRows(nodes.first[at(s)], columns);
        for (Eigen::Index i = 0; i < rest; ++i) below.row(i) = x.row(rows[static_cast<std::size_t>(columns + i)]);
        mine.noalias() -= own.bottomRows(rest).transpose() * below.topRows(rest);
        own.topRows(columns).triangularView<Eigen::Lower>().transpose().solveInPlace(mine);
    }
    Matrix result(right.rows(), right.cols());
    for (Eigen::Index k = 0; k < x.rows(); ++k) result.row(nodes.permutation[static_cast<std::size_t>(k)]) = x.row(k);
    return result;
}

Points SparseCholesky::solve(const Points& right) const {
    return data_->solve(right);
}

Eigen::VectorXd SparseCholesky::solve_vector(const Eigen::VectorXd& right) const {
    return data_->solve(right);
}

} // namespace meshtween
