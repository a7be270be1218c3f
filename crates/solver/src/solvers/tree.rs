//! Spanning trees as tours: down one branch after the other, each stop where the tree is first come to.

/// A tree over candidates: the children of each, in the order in which they are visited.
#[derive(Clone, Debug)]
pub struct Tree {
    children: Vec<Vec<u32>>,
}

impl Tree {
    /// No edges among so many candidates.
    pub fn new(candidates: usize) -> Self {
        Self { children: vec![Vec::new(); candidates] }
    }

    /// Hangs a candidate below another, behind those that hang there.
    pub fn hang(&mut self, parent: u32, child: u32) {
        self.children[parent as usize].push(child);
    }

    /// Takes away the child that was hung last.
    pub fn drop_last(&mut self, parent: u32) {
        self.children[parent as usize].pop();
    }

    /// The candidates below these roots, and they themselves, in preorder: the walk around the tree, in which
    /// every edge is gone there and back, cut short where it would come to a candidate again.
    pub fn preorder(&self, roots: &[u32]) -> Vec<u32> {
        let mut order = Vec::new();
        let mut ahead: Vec<u32> = roots.iter().rev().copied().collect();
        while let Some(next) = ahead.pop() {
            order.push(next);
            ahead.extend(self.children[next as usize].iter().rev());
        }
        order
    }
}
