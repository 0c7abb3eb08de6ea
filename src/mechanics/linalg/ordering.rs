//! Numbering of unknowns with a small bandwidth: reverse Cuthill–McKee ordering (George & Liu 1981).

use std::collections::VecDeque;

#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Ordering {
    /// New number of each unknown: `position[old]`.
    pub position: Vec<usize>,
    pub half_bandwidth: usize,
}

/// Numbers `count` unknowns for a small bandwidth. All unknowns of a group are coupled with each other.
///
/// The given numbering is kept unless the reverse Cuthill–McKee numbering has a smaller bandwidth.
pub fn reverse_cuthill_mckee(count: usize, groups: &[Vec<usize>]) -> Ordering {
    let given: Vec<usize> = (0..count).collect();
    let reordered = order_by_levels(count, groups);
    let (wide, narrow) = (half_bandwidth(&given, groups), half_bandwidth(&reordered, groups));
    if narrow < wide {
        Ordering { position: reordered, half_bandwidth: narrow }
    } else {
        Ordering { position: given, half_bandwidth: wide }
    }
}

fn half_bandwidth(position: &[usize], groups: &[Vec<usize>]) -> usize {
    let width = |group: &Vec<usize>| {
        let numbers = group.iter().map(|&member| position[member]);
        numbers.clone().max().unwrap_or(0) - numbers.min().unwrap_or(0)
    };
    groups.iter().map(width).max().unwrap_or(0)
}

fn order_by_levels(count: usize, groups: &[Vec<usize>]) -> Vec<usize> {
    let mut groups_of = vec![Vec::new(); count];
    for (index, group) in groups.iter().enumerate() {
        for &member in group {
            groups_of[member].push(index);
        }
    }
    let neighbours =
        |node: usize| groups_of[node].iter().flat_map(|&group| groups[group].iter().copied());
    // The search for the first unknown starts at unknowns with few couplings, because they are close to a free end of the structure.
    let degree =
        |node: usize| groups_of[node].iter().map(|&group| groups[group].len()).sum::<usize>();

    let mut seeds: Vec<usize> = (0..count).collect();
    seeds.sort_by_key(|&node| degree(node));
    let mut visited = vec![false; count];
    let mut order = Vec::with_capacity(count);
    for seed in seeds {
        if visited[seed] {
            continue;
        }
        let start = farthest(seed, count, &neighbours);
        let mut queue = VecDeque::from([start]);
        visited[start] = true;
        while let Some(node) = queue.pop_front() {
            order.push(node);
            let mut next: Vec<usize> = Vec::new();
            for neighbour in neighbours(node) {
                if !visited[neighbour] {
                    visited[neighbour] = true;
                    next.push(neighbour);
                }
            }
            next.sort_by_key(|&neighbour| degree(neighbour));
            queue.extend(next);
        }
    }
    let mut position = vec![0; count];
    for (new, &old) in order.iter().rev().enumerate() {
        position[old] = new;
    }
    position
}

fn farthest<I: Iterator<Item = usize>>(
    seed: usize,
    count: usize,
    neighbours: &impl Fn(usize) -> I,
) -> usize {
    let mut last = seed;
    for _ in 0..2 {
        let mut seen = vec![false; count];
        let mut queue = VecDeque::from([last]);
        seen[last] = true;
        while let Some(node) = queue.pop_front() {
            last = node;
            for neighbour in neighbours(node) {
                if !seen[neighbour] {
                    seen[neighbour] = true;
                    queue.push_back(neighbour);
                }
            }
        }
    }
    last
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cuthill_mckee_keeps_the_natural_order_of_a_chain() {
        let groups: Vec<Vec<usize>> = (0..9).map(|i| vec![i, i + 1]).collect();
        let ordering = reverse_cuthill_mckee(10, &groups);
        assert_eq!(ordering.half_bandwidth, 1);
        assert_eq!(ordering.position, (0..10).collect::<Vec<_>>());
    }

    #[test]
    fn shuffled_chain_and_ring_get_the_smallest_bandwidth() {
        let shuffle = |i: usize| (i * 7) % 20;
        let chain: Vec<Vec<usize>> = (0..19).map(|i| vec![shuffle(i), shuffle(i + 1)]).collect();
        assert_eq!(reverse_cuthill_mckee(20, &chain).half_bandwidth, 1);
        let ring: Vec<Vec<usize>> = (0..20).map(|i| vec![i, (i + 1) % 20]).collect();
        assert_eq!(reverse_cuthill_mckee(20, &ring).half_bandwidth, 2);
    }

    #[test]
    fn numbering_with_disconnected_parts_is_a_permutation() {
        let groups = vec![vec![0, 5], vec![5, 2], vec![7, 1]];
        let mut position = reverse_cuthill_mckee(9, &groups).position;
        position.sort_unstable();
        assert_eq!(position, (0..9).collect::<Vec<_>>());
    }
}
