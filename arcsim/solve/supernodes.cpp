#include "arcsim/solve/supernodes.hpp"

#include <algorithm>
#include <numeric>

namespace arcsim {
namespace {

using Lists = std::vector<std::vector<int>>;

/// Columns with the same structure, before merging: the last column's rows, and the columns.
struct Draft {
    std::vector<int> cols, rows;   // places; rows ascending
    int parent = -1;
    bool merged = false;           // into its parent
};

/// The elimination tree: parent of each column (Liu's algorithm with path compression).
std::vector<int> elimination_tree(const BlockPattern& p) {
    const int n = p.n_nodes();
    std::vector<std::vector<int>> left(n);   // earlier neighbours
    for (int j = 0; j < n; ++j)
        for (int k = p.block_ptr()[j] + 1; k < p.block_ptr()[j + 1]; ++k) left[p.block_row()[k]].push_back(j);
    std::vector<int> parent(n, -1), ancestor(n, -1);
    for (int i = 0; i < n; ++i)
        for (int j : left[i])
            while (j != -1 && j != i) {
                const int next = ancestor[j];
                ancestor[j] = i;
                if (next == -1) parent[j] = i;
                j = next;
            }
    return parent;
}

/// Fundamental supernodes with their rows: each column's rows are its own and its children's.
std::vector<Draft> fundamental_supernodes(const BlockPattern& p) {
    const int n = p.n_nodes();
    const std::vector<int> parent = elimination_tree(p);
    Lists children(n);
    for (int j = 0; j < n; ++j)
        if (parent[j] >= 0) children[parent[j]].push_back(j);
    Lists rows(n);   // alive until the parent has taken them over
    std::vector<int> mark(n, -1), draft_of(n);
    std::vector<Draft> drafts;
    for (int j = 0; j < n; ++j) {
        std::vector<int> mine;
        if (!children[j].empty()) {   // start from the longest child's rows, already in order
            const int heir = *std::max_element(children[j].begin(), children[j].end(),
                                               [&](int a, int b) { return rows[a].size() < rows[b].size(); });
            mine.swap(rows[heir]);
            mine.erase(mine.begin());   // j itself
        }
        for (int r : mine) mark[r] = j;
        const std::size_t inherited = mine.size();
        const auto take = [&](int r) {
            if (r <= j || mark[r] == j) return;
            mark[r] = j;
            mine.push_back(r);
        };
        for (int k = p.block_ptr()[j] + 1; k < p.block_ptr()[j + 1]; ++k) take(p.block_row()[k]);
        for (int c : children[j]) {
            for (int r : rows[c]) take(r);
            rows[c] = {};
        }
        std::sort(mine.begin() + inherited, mine.end());
        std::inplace_merge(mine.begin(), mine.begin() + inherited, mine.end());
        const bool same = children[j].size() == 1 && children[j][0] == j - 1 && inherited == mine.size();
        if (!same) drafts.emplace_back();
        draft_of[j] = static_cast<int>(drafts.size()) - 1;
        drafts.back().cols.push_back(j);
        drafts.back().rows = mine;
        rows[j] = std::move(mine);
    }
    for (Draft& d : drafts)
        if (!d.rows.empty()) d.parent = draft_of[d.rows.front()];
    return drafts;
}

double panel_nonzeros(double w, double m) { return w * (w + 1) / 2 + w * m; }
double panel_flops(double w, double m) { return w * w * w / 3 + w * w * m + w * m * m; }

/// What a supernode of w columns and m rows below costs, in the time of one flop at full speed. The weights are rounded
/// measurements (AVX-512, single precision); the result depends on them weakly.
double panel_cost(double w, double m) {
    constexpr double short_columns = 6;   // columns' worth of loading and storing a tile of the update
    constexpr double scatter = 50;        // per entry that is added to a later supernode
    constexpr double store = 300;         // per entry of the panel: cleared, filled, read by several solves
    constexpr double overhead = 40000;    // per supernode
    return w * w * w / 3 + w * w * m + (w + short_columns) * m * m + scatter * m * m / 2 +
           store * panel_nonzeros(w, m) + overhead;
}

/// Merges children into their parents while that is cheaper.
void merge_small(std::vector<Draft>& drafts) {
    Lists children(drafts.size());
    for (std::size_t s = 0; s < drafts.size(); ++s)
        if (drafts[s].parent >= 0) children[drafts[s].parent].push_back(static_cast<int>(s));
    for (std::size_t s = 0; s < drafts.size(); ++s) {
        Draft& p = drafts[s];
        const auto cost = [](const Draft& d) { return panel_cost(3.0 * d.cols.size(), 3.0 * d.rows.size()); };
        // Children whose rows fill most of the parent's lose least.
        std::stable_sort(children[s].begin(), children[s].end(),
                         [&](int a, int b) { return drafts[a].rows.size() > drafts[b].rows.size(); });
        for (int c : children[s]) {
            Draft& child = drafts[c];
            const double together = panel_cost(3.0 * (p.cols.size() + child.cols.size()), 3.0 * p.rows.size());
            if (together >= cost(p) + cost(child)) continue;
            child.merged = true;
            p.cols.insert(p.cols.begin(), child.cols.begin(), child.cols.end());
        }
    }
}

}  // namespace

Supernodes::Supernodes(const BlockPattern& pattern) : position_(pattern.n_nodes()), owner_(pattern.n_nodes()) {
    std::vector<Draft> drafts = fundamental_supernodes(pattern);
    merge_small(drafts);
    // Drafts are in an order in which children come before parents, merged ones within their parent.
    int next = 0;
    for (const Draft& d : drafts) {
        if (d.merged) continue;
        for (int place : d.cols) {
            owner_[next] = static_cast<int>(list_.size());
            position_[place] = next++;
        }
        list_.push_back({next - static_cast<int>(d.cols.size()), static_cast<int>(d.cols.size()), 0, 0, 0, 0});
    }
    std::size_t s = 0;
    for (const Draft& d : drafts) {
        if (d.merged) continue;
        Supernode& node = list_[s++];
        node.row_begin = static_cast<int>(rows_.size());
        node.n_rows = static_cast<int>(d.rows.size());
        for (int place : d.rows) rows_.push_back(position_[place]);
        std::sort(rows_.begin() + node.row_begin, rows_.end());
        nonzeros_ += panel_nonzeros(3.0 * node.n_cols, 3.0 * node.n_rows);
        flops_ += panel_flops(3.0 * node.n_cols, 3.0 * node.n_rows);
    }
    for (Supernode& node : list_) {
        node.update_begin = static_cast<int>(updates_.size());
        for (int k = 0; k < node.n_rows;) {
            const int* row = rows_.data() + node.row_begin;
            Update u{owner_[row[k]], k, 0, static_cast<int>(local_rows_.size())};
            while (k < node.n_rows && owner_[row[k]] == u.target) ++k;
            u.n = k - u.row;
            // Both lists ascend: one walk finds all rows.
            const Supernode& t = list_[u.target];
            int at = t.row_begin;
            for (int r = u.row; r < node.n_rows; ++r) {
                if (row[r] < t.first + t.n_cols) {
                    local_rows_.push_back(row[r] - t.first);
                    continue;
                }
                while (rows_[at] != row[r]) ++at;
                local_rows_.push_back(t.n_cols + at - t.row_begin);
            }
            updates_.push_back(u);
        }
        node.update_end = static_cast<int>(updates_.size());
    }
}

int Supernodes::local(int s, int r) const {
    const Supernode& node = list_[s];
    if (r < node.first + node.n_cols) return r - node.first;
    const auto begin = rows_.begin() + node.row_begin;
    return node.n_cols + static_cast<int>(std::lower_bound(begin, begin + node.n_rows, r) - begin);
}

}  // namespace arcsim
