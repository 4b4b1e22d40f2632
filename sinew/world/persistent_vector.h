// A vector whose copy costs one reference count: copies share their nodes until one of them
// changes, and two versions can be compared at the cost of what differs. Nodes hold 32 items; a
// change copies one node of each level, once for each *editor*: what has been made under the same
// edit token is changed in place (Bagwell and Rompf 2011; the tokens are Clojure's transients).
//
// A version that was handed to readers must not be edited under the token that made it: an edit
// starts with a token of its own.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <new>
#include <utility>

#include "sinew/graph/pages.h"

namespace sinew::world {

using EditToken = std::uint64_t;
EditToken fresh_token();  // never the same again in this process; never 0

template <typename T>
class PersistentVector {
  static constexpr unsigned kBits = 5;
  static constexpr std::size_t kWidth = 1u << kBits;

 public:
  PersistentVector() = default;
  PersistentVector(const PersistentVector& other)
      : root_(other.root_), depth_(other.depth_), size_(other.size_) {
    retain(root_);
  }
  PersistentVector(PersistentVector&& other) noexcept { swap(other); }
  PersistentVector& operator=(PersistentVector other) noexcept {
    swap(other);
    return *this;
  }
  ~PersistentVector() { release(root_, depth_); }

  std::size_t size() const { return size_; }

  // Null where nothing was ever put.
  const T* find(std::size_t index) const {
    if (index >= size_ || !root_) return nullptr;
    const Node* node = root_;
    for (unsigned level = depth_; level > 0; --level) {
      node = child(node, index, level);
      if (!node) return nullptr;
    }
    return &static_cast<const Leaf*>(node)->items[index % kWidth];
  }
  const T& operator[](std::size_t index) const { return *find(index); }

  // The item to be changed, made if need be (items in between read as T{} or as null).
  T& edit(std::size_t index, EditToken token) {
    while (!root_ || index >= (kWidth << (depth_ * kBits))) {
      if (!root_) {
        while (index >= (kWidth << (depth_ * kBits))) ++depth_;
        break;
      }
      Branch* const root = new Branch(token);
      root->nodes[0] = root_;
      root_ = root;
      ++depth_;
    }
    if (index >= size_) size_ = index + 1;
    Node** slot = &root_;
    for (unsigned level = depth_;; --level) {
      own(*slot, level, token);
      if (level == 0) return static_cast<Leaf*>(*slot)->items[index % kWidth];
      slot = &static_cast<Branch*>(*slot)->nodes[(index >> (level * kBits)) % kWidth];
    }
  }
  std::size_t push_back(T item, EditToken token) {
    const std::size_t index = size_;
    edit(index, token) = std::move(item);
    return index;
  }

  // Calls visit(index, const T* before, const T* after) for each item that may differ: all items of
  // every leaf that the two do not share.
  template <typename Visit>
  static void differences(const PersistentVector& before, const PersistentVector& after,
                          Visit&& visit) {
    const std::size_t size = before.size_ > after.size_ ? before.size_ : after.size_;
    for (std::size_t index = 0; index < size;) {
      std::size_t step = kWidth;
      const Node* const a = before.shared_at(index, step);
      std::size_t other = kWidth;
      const Node* const b = after.shared_at(index, other);
      if (step == other && a == b && a) {
        index = (index / step + 1) * step;
        continue;
      }
      // One level at a time: leaves at last.
      const Node* const leaf_a = before.leaf(index);
      const Node* const leaf_b = after.leaf(index);
      const std::size_t end = (index / kWidth + 1) * kWidth;
      if (leaf_a == leaf_b) {
        index = end;
        continue;
      }
      for (; index < end && index < size; ++index) {
        visit(index, before.find(index), after.find(index));
      }
    }
  }

 private:
  struct Node {
    explicit Node(EditToken edit_token) : token(edit_token) {}
    std::atomic<std::uint32_t> owners = 1;
    EditToken token;
  };
  struct Branch : Node {
    using Node::Node;
    Node* nodes[kWidth] = {};
  };
  struct Leaf : Node {
    using Node::Node;
    static_assert(alignof(T) <= alignof(std::max_align_t));
    // Large ones come from the pages that stores keep for one another (sinew/graph/pages.h).
    static constexpr bool kOfPages = sizeof(T) * kWidth > 1024;
    static void* operator new(std::size_t size) {
      return kOfPages ? graph::allocate_raw(size) : ::operator new(size);
    }
    static void operator delete(void* leaf, std::size_t size) {
      kOfPages ? graph::release_pages(leaf, size) : ::operator delete(leaf, size);
    }
    T items[kWidth] = {};
  };

  // Precondition: level > 0.
  static const Node* child(const Node* node, std::size_t index, unsigned level) {
    return static_cast<const Branch*>(node)->nodes[(index >> (level * kBits)) % kWidth];
  }

  static void retain(Node* node) {
    if (node) node->owners.fetch_add(1, std::memory_order_relaxed);
  }
  static void release(Node* node, unsigned level) {
    if (!node || node->owners.fetch_sub(1, std::memory_order_acq_rel) != 1) return;
    if (level == 0) {
      delete static_cast<Leaf*>(node);
      return;
    }
    Branch* const branch = static_cast<Branch*>(node);
    for (Node* const each : branch->nodes) release(each, level - 1);
    delete branch;
  }
  static void own(Node*& node, unsigned level, EditToken token) {
    if (node && node->token == token) return;
    Node* const shared = node;
    if (level == 0) {
      Leaf* const copy = new Leaf(token);
      if (shared) {
        for (std::size_t i = 0; i < kWidth; ++i) {
          copy->items[i] = static_cast<Leaf*>(shared)->items[i];
        }
      }
      node = copy;
    } else {
      Branch* const copy = new Branch(token);
      if (shared) {
        for (std::size_t i = 0; i < kWidth; ++i) {
          copy->nodes[i] = static_cast<Branch*>(shared)->nodes[i];
          retain(copy->nodes[i]);
        }
      }
      node = copy;
    }
    release(shared, level);
  }
  const Node* leaf(std::size_t index) const {
    if (!root_ || index >= size_) return nullptr;
    const Node* node = root_;
    for (unsigned level = depth_; level > 0 && node; --level) {
      node = child(node, index, level);
    }
    return node;
  }
  // The highest node that begins at `index`, and how many items it spans.
  const Node* shared_at(std::size_t index, std::size_t& span) const {
    if (!root_ || index >= size_) return nullptr;
    const Node* node = root_;
    unsigned level = depth_;
    span = kWidth << (level * kBits);
    while (node && level > 0 && index % span != 0) {
      node = child(node, index, level);
      --level;
      span >>= kBits;
    }
    return node;
  }
  void swap(PersistentVector& other) noexcept {
    std::swap(root_, other.root_);
    std::swap(depth_, other.depth_);
    std::swap(size_, other.size_);
  }

  Node* root_ = nullptr;
  unsigned depth_ = 0;  // 0: the root is a leaf
  std::size_t size_ = 0;
};

}  // namespace sinew::world
