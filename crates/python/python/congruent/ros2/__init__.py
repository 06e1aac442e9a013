"""The judge on a robot that runs, and scenarios and logs as joint states, over ROS 2.

    python -m congruent.ros2 watch robots/ur5e
    python -m congruent.ros2 play scenarios/ur5e_pick.toml

No installation of ROS is needed: messages go over CycloneDDS (``pip install 'congruent[ros2]'``), or over ``rclpy`` of
an installed ROS. It observes and reports, and never commands a robot: ``_transport.WRITABLE`` has all that it may publish.

``_messages`` has the messages as the rest of the package sees them, ``_wire`` those of ROS made from them; ``_dds`` and ``_rclpy``
carry them.
"""
